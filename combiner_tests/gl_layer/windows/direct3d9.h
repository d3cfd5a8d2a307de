/* The calls of Direct3D 9 for texture_stages.c. */
#include <d3d9.h>
#include <string.h>

static IDirect3DDevice9* device;

static int make_device(HWND window) {
  D3DPRESENT_PARAMETERS parameters;
  IDirect3D9* direct3d = Direct3DCreate9(D3D_SDK_VERSION);
  memset(&parameters, 0, sizeof parameters);
  parameters.Windowed = TRUE;
  parameters.SwapEffect = D3DSWAPEFFECT_DISCARD;
  parameters.BackBufferFormat = D3DFMT_A8R8G8B8;
  parameters.BackBufferWidth = parameters.BackBufferHeight = PIXELS;
  parameters.hDeviceWindow = window;
  return direct3d && SUCCEEDED(IDirect3D9_CreateDevice(direct3d, 0, D3DDEVTYPE_HAL, window,
                                                       D3DCREATE_SOFTWARE_VERTEXPROCESSING, &parameters, &device));
}

static DWORD pixel_shaders(void) {
  D3DCAPS9 caps;
  IDirect3DDevice9_GetDeviceCaps(device, &caps);
  return caps.PixelShaderVersion >> 8 & 255;
}

static void set_stage(DWORD stage, D3DTEXTURESTAGESTATETYPE type, DWORD value) {
  IDirect3DDevice9_SetTextureStageState(device, stage, type, value);
}

static void set_texture(DWORD unit, const DWORD* texels) {
  IDirect3DTexture9* texture;
  D3DLOCKED_RECT rows;
  int y;
  IDirect3DDevice9_CreateTexture(device, SIDE, SIDE, 1, 0, D3DFMT_A8R8G8B8, D3DPOOL_MANAGED, &texture, NULL);
  IDirect3DTexture9_LockRect(texture, 0, &rows, NULL, 0);
  for (y = 0; y < SIDE; ++y) memcpy((char*)rows.pBits + y * rows.Pitch, texels + y * SIDE, SIDE * sizeof *texels);
  IDirect3DTexture9_UnlockRect(texture, 0);
  IDirect3DDevice9_SetTexture(device, unit, (IDirect3DBaseTexture9*)texture);
  IDirect3DDevice9_SetSamplerState(device, unit, D3DSAMP_MAGFILTER, D3DTEXF_POINT);
  IDirect3DDevice9_SetSamplerState(device, unit, D3DSAMP_MINFILTER, D3DTEXF_POINT);
}

static void begin_picture(void) {
  IDirect3DDevice9_Clear(device, 0, NULL, D3DCLEAR_TARGET, CLEAR_COLOR, 1, 0);
  IDirect3DDevice9_BeginScene(device);
  IDirect3DDevice9_SetRenderState(device, D3DRS_LIGHTING, FALSE);
  IDirect3DDevice9_SetRenderState(device, D3DRS_ZENABLE, FALSE);
  IDirect3DDevice9_SetRenderState(device, D3DRS_CULLMODE, D3DCULL_NONE);
  IDirect3DDevice9_SetRenderState(device, D3DRS_TEXTUREFACTOR, FACTOR_COLOR);
}

static void draw_triangles(const Corner* vertices, DWORD count) {
  IDirect3DDevice9_SetFVF(device, D3DFVF_XYZ | D3DFVF_DIFFUSE | D3DFVF_TEX1);
  IDirect3DDevice9_DrawPrimitiveUP(device, D3DPT_TRIANGLELIST, count, vertices, sizeof *vertices);
}

static void end_picture(void) {
  IDirect3DDevice9_EndScene(device);
}

static void read_picture(DWORD* pixels) {
  IDirect3DSurface9 *target, *copy;
  D3DLOCKED_RECT rows;
  int y;
  IDirect3DDevice9_GetRenderTarget(device, 0, &target);
  IDirect3DDevice9_CreateOffscreenPlainSurface(device, PIXELS, PIXELS, D3DFMT_A8R8G8B8, D3DPOOL_SYSTEMMEM, &copy, NULL);
  IDirect3DDevice9_GetRenderTargetData(device, target, copy);
  IDirect3DSurface9_LockRect(copy, &rows, NULL, D3DLOCK_READONLY);
  for (y = 0; y < PIXELS; ++y) memcpy(pixels + y * PIXELS, (char*)rows.pBits + y * rows.Pitch, PIXELS * sizeof *pixels);
  IDirect3DSurface9_UnlockRect(copy);
  IDirect3DSurface9_Release(copy);
  IDirect3DSurface9_Release(target);
}
