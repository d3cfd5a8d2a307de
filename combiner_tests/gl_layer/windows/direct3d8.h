/* The calls of Direct3D 8 for texture_stages.c. */
#include <d3d8.h>
#include <string.h>

static IDirect3DDevice8* device;

static int make_device(HWND window) {
  D3DPRESENT_PARAMETERS parameters;
  HMODULE library = LoadLibraryA("d3d8.dll"); /* the compiler has no import library */
  IDirect3D8*(WINAPI * create)(UINT) = (IDirect3D8 * (WINAPI*)(UINT))(void*)GetProcAddress(library, "Direct3DCreate8");
  IDirect3D8* direct3d = create ? create(D3D_SDK_VERSION) : NULL;
  memset(&parameters, 0, sizeof parameters);
  parameters.Windowed = TRUE;
  parameters.SwapEffect = D3DSWAPEFFECT_DISCARD;
  parameters.BackBufferFormat = D3DFMT_A8R8G8B8;
  parameters.BackBufferWidth = parameters.BackBufferHeight = PIXELS;
  parameters.hDeviceWindow = window;
  return direct3d && SUCCEEDED(IDirect3D8_CreateDevice(direct3d, 0, D3DDEVTYPE_HAL, window,
                                                       D3DCREATE_SOFTWARE_VERTEXPROCESSING, &parameters, &device));
}

static DWORD pixel_shaders(void) {
  D3DCAPS8 caps;
  IDirect3DDevice8_GetDeviceCaps(device, &caps);
  return caps.PixelShaderVersion >> 8 & 255;
}

static void set_stage(DWORD stage, D3DTEXTURESTAGESTATETYPE type, DWORD value) {
  IDirect3DDevice8_SetTextureStageState(device, stage, type, value);
}

static void set_texture(DWORD unit, const DWORD* texels) {
  IDirect3DTexture8* texture;
  D3DLOCKED_RECT rows;
  int y;
  IDirect3DDevice8_CreateTexture(device, SIDE, SIDE, 1, 0, D3DFMT_A8R8G8B8, D3DPOOL_MANAGED, &texture);
  IDirect3DTexture8_LockRect(texture, 0, &rows, NULL, 0);
  for (y = 0; y < SIDE; ++y) memcpy((char*)rows.pBits + y * rows.Pitch, texels + y * SIDE, SIDE * sizeof *texels);
  IDirect3DTexture8_UnlockRect(texture, 0);
  IDirect3DDevice8_SetTexture(device, unit, (IDirect3DBaseTexture8*)texture);
  set_stage(unit, D3DTSS_MAGFILTER, D3DTEXF_POINT);
  set_stage(unit, D3DTSS_MINFILTER, D3DTEXF_POINT);
}

static void begin_picture(void) {
  IDirect3DDevice8_Clear(device, 0, NULL, D3DCLEAR_TARGET, CLEAR_COLOR, 1, 0);
  IDirect3DDevice8_BeginScene(device);
  IDirect3DDevice8_SetRenderState(device, D3DRS_LIGHTING, FALSE);
  IDirect3DDevice8_SetRenderState(device, D3DRS_ZENABLE, FALSE);
  IDirect3DDevice8_SetRenderState(device, D3DRS_CULLMODE, D3DCULL_NONE);
  IDirect3DDevice8_SetRenderState(device, D3DRS_TEXTUREFACTOR, FACTOR_COLOR);
}

static void draw_triangles(const Corner* vertices, DWORD count) {
  IDirect3DDevice8_SetVertexShader(device, D3DFVF_XYZ | D3DFVF_DIFFUSE | D3DFVF_TEX1);
  IDirect3DDevice8_DrawPrimitiveUP(device, D3DPT_TRIANGLELIST, count, vertices, sizeof *vertices);
}

static void end_picture(void) {
  IDirect3DDevice8_EndScene(device);
}

static void read_picture(DWORD* pixels) {
  IDirect3DSurface8 *target, *copy;
  D3DLOCKED_RECT rows;
  int y;
  IDirect3DDevice8_GetRenderTarget(device, &target);
  IDirect3DDevice8_CreateImageSurface(device, PIXELS, PIXELS, D3DFMT_A8R8G8B8, &copy);
  IDirect3DDevice8_CopyRects(device, target, NULL, 0, copy, NULL);
  IDirect3DSurface8_LockRect(copy, &rows, NULL, D3DLOCK_READONLY);
  for (y = 0; y < PIXELS; ++y) memcpy(pixels + y * PIXELS, (char*)rows.pBits + y * rows.Pitch, PIXELS * sizeof *pixels);
  IDirect3DSurface8_UnlockRect(copy);
  IDirect3DSurface8_Release(copy);
  IDirect3DSurface8_Release(target);
}
