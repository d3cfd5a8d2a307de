// A title's module that fills definitions in several ways.
#include "renderer.h"

#define STAGE_TEX(n) (PS_REGISTER_T0 + (n))
#define ZERO_OUT PS_COMBINEROUTPUTS(PS_REGISTER_DISCARD, PS_REGISTER_DISCARD, PS_REGISTER_DISCARD, 0)

enum GlowQuality { GLOW_LOW, GLOW_HIGH };

static void SetColorStage(D3DPIXELSHADERDEF* def, int stage, DWORD inputs, DWORD outputs) {
  def->PSRGBInputs[stage] = inputs;
  def->PSRGBOutputs[stage] = outputs;
  def->PSAlphaOutputs[stage] = ZERO_OUT;
}

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

void BuildGlow(GlowQuality quality) {
  static D3DPIXELSHADERDEF s_glow;
  D3DPIXELSHADERDEF* glow = &s_glow;
  memset(glow, 0, sizeof(*glow));
  const int stages = quality == GLOW_HIGH ? 3 : 1;
  for (int i = 0; i < stages; ++i) {
    SetColorStage(glow, i, PS_COMBINERINPUTS(STAGE_TEX(i), PS_REGISTER_V0, PS_REGISTER_R0, i == 0 ? 0 : PS_REGISTER_C0),
                  PS_COMBINEROUTPUTS(PS_REGISTER_DISCARD, PS_REGISTER_DISCARD, PS_REGISTER_R0, 0));
  }
  switch (quality) {
    case GLOW_LOW:
      glow->PSConstant1[0] = 0xff000000;
      break;
    case GLOW_HIGH:
      glow->PSConstant1[2] = 0xff00ff00;
      break;
  }
  glow->PSCombinerCount = stages;
  glow->PSCombinerCount |= PS_COMBINERCOUNT(0, PS_COMBINERCOUNT_UNIQUE_C0);
  glow->PSFinalCombinerInputsABCD = PS_COMBINERINPUTS(0, 0, 0, PS_REGISTER_R0);
  UploadGlow(glow);
}
