HRESULT CreateLightmapShader(LPDIRECT3DDEVICE8 device, DWORD* handle) {
  D3DPIXELSHADERDEF psd;
  ZeroMemory(&psd, sizeof(psd));

  psd.PSTextureModes =
      PS_TEXTUREMODES(PS_TEXTUREMODES_PROJECT2D, PS_TEXTUREMODES_PROJECT2D, PS_TEXTUREMODES_NONE, PS_TEXTUREMODES_NONE);
  psd.PSCombinerCount = PS_COMBINERCOUNT(1, PS_COMBINERCOUNT_MUX_MSB | PS_COMBINERCOUNT_UNIQUE_C0);
  psd.PSRGBInputs[0] = PS_COMBINERINPUTS(STAGE_TEX(0) | PS_CHANNEL_RGB, STAGE_TEX(1) | PS_INPUTMAPPING_EXPAND_NORMAL,
                                         PS_REGISTER_ZERO, PS_REGISTER_ZERO);
  psd.PSRGBOutputs[0] = PS_COMBINEROUTPUTS(PS_REGISTER_R0, PS_REGISTER_DISCARD, PS_REGISTER_DISCARD, 0);
  psd.PSConstant0[0] = D3DCOLOR_ARGB(255, 128, 64, 32);
  psd.PSFinalCombinerInputsABCD = PS_COMBINERINPUTS(0, 0, 0, PS_REGISTER_R0);
  psd.PSFinalCombinerInputsEFG = PS_COMBINERINPUTS(0, 0, PS_REGISTER_R0 | PS_CHANNEL_ALPHA, 0);
  return device->CreatePixelShader(&psd, handle);
}
void stage(D3DPIXELSHADERDEF* d, int i) {
  d->PSRGBInputs[i] |= PS_COMBINERINPUTS(PS_REGISTER_T0 + i, 4, 0, 0);
}
void all() {
  ZeroMemory(&d, 240);
  for (int i = 0; i < 2; ++i) stage(&d, i);
  d.PSCombinerCount = d.PSRGBInputs[1] & 2;
}
