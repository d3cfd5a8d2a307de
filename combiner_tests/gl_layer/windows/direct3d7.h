/* The calls of Direct3D 7 for texture_stages.c. */
#define DIRECTDRAW_VERSION 0x0700
#define DIRECT3D_VERSION 0x0700
#include <d3d.h>
#include <ddraw.h>
#include <string.h>

static IDirectDraw7* direct_draw;
static IDirectDrawSurface7* target;
static IDirect3DDevice7* device;

/* A surface of bytes in the order of the other versions' A8R8G8B8. */
static IDirectDrawSurface7* make_surface(DWORD side, DWORD caps, DWORD caps2) {
  DDSURFACEDESC2 facts;
  IDirectDrawSurface7* surface = NULL;
  memset(&facts, 0, sizeof facts);
  facts.dwSize = sizeof facts;
  facts.dwFlags = DDSD_CAPS | DDSD_WIDTH | DDSD_HEIGHT | DDSD_PIXELFORMAT;
  facts.dwWidth = facts.dwHeight = side;
  facts.ddsCaps.dwCaps = caps;
  facts.ddsCaps.dwCaps2 = caps2;
  facts.ddpfPixelFormat.dwSize = sizeof facts.ddpfPixelFormat;
  facts.ddpfPixelFormat.dwFlags = DDPF_RGB | DDPF_ALPHAPIXELS;
  facts.ddpfPixelFormat.dwRGBBitCount = 32;
  facts.ddpfPixelFormat.dwRBitMask = 0xff0000;
  facts.ddpfPixelFormat.dwGBitMask = 0xff00;
  facts.ddpfPixelFormat.dwBBitMask = 0xff;
  facts.ddpfPixelFormat.dwRGBAlphaBitMask = 0xff000000;
  return SUCCEEDED(IDirectDraw7_CreateSurface(direct_draw, &facts, &surface, NULL)) ? surface : NULL;
}

static int make_device(HWND window) {
  IDirect3D7* direct3d;
  D3DVIEWPORT7 whole = {0, 0, PIXELS, PIXELS, 0, 1};
  if (FAILED(DirectDrawCreateEx(NULL, (void**)&direct_draw, &IID_IDirectDraw7, NULL))) return 0;
  IDirectDraw7_SetCooperativeLevel(direct_draw, window, DDSCL_NORMAL);
  target = make_surface(PIXELS, DDSCAPS_OFFSCREENPLAIN | DDSCAPS_3DDEVICE | DDSCAPS_VIDEOMEMORY, 0);
  if (!target || FAILED(IDirectDraw7_QueryInterface(direct_draw, &IID_IDirect3D7, (void**)&direct3d))) return 0;
  if (FAILED(IDirect3D7_CreateDevice(direct3d, &IID_IDirect3DHALDevice, target, &device))) return 0;
  return SUCCEEDED(IDirect3DDevice7_SetViewport(device, &whole));
}

static DWORD pixel_shaders(void) {
  return 0;
}

static void set_stage(DWORD stage, D3DTEXTURESTAGESTATETYPE type, DWORD value) {
  IDirect3DDevice7_SetTextureStageState(device, stage, type, value);
}

static void copy_rows(IDirectDrawSurface7* surface, DWORD* pixels, int side, int write) {
  DDSURFACEDESC2 rows;
  int y;
  memset(&rows, 0, sizeof rows);
  rows.dwSize = sizeof rows;
  IDirectDrawSurface7_Lock(surface, NULL, &rows, DDLOCK_WAIT, NULL);
  for (y = 0; y < side; ++y) {
    char* row = (char*)rows.lpSurface + y * rows.lPitch;
    memcpy(write ? row : (char*)(pixels + y * side), write ? (char*)(pixels + y * side) : row,
           (size_t)side * sizeof *pixels);
  }
  IDirectDrawSurface7_Unlock(surface, NULL);
}

static void set_texture(DWORD unit, DWORD* texels) {
  IDirectDrawSurface7* texture = make_surface(SIDE, DDSCAPS_TEXTURE, DDSCAPS2_TEXTUREMANAGE);
  copy_rows(texture, texels, SIDE, 1);
  IDirect3DDevice7_SetTexture(device, unit, texture);
  set_stage(unit, D3DTSS_MAGFILTER, D3DTFG_POINT);
  set_stage(unit, D3DTSS_MINFILTER, D3DTFN_POINT);
}

static void begin_picture(void) {
  IDirect3DDevice7_Clear(device, 0, NULL, D3DCLEAR_TARGET, CLEAR_COLOR, 1, 0);
  IDirect3DDevice7_BeginScene(device);
  IDirect3DDevice7_SetRenderState(device, D3DRENDERSTATE_LIGHTING, FALSE);
  IDirect3DDevice7_SetRenderState(device, D3DRENDERSTATE_ZENABLE, FALSE);
  IDirect3DDevice7_SetRenderState(device, D3DRENDERSTATE_CULLMODE, D3DCULL_NONE);
  IDirect3DDevice7_SetRenderState(device, D3DRENDERSTATE_TEXTUREFACTOR, FACTOR_COLOR);
}

static void draw_triangles(Corner* vertices, DWORD count) {
  IDirect3DDevice7_DrawPrimitive(device, D3DPT_TRIANGLELIST, D3DFVF_XYZ | D3DFVF_DIFFUSE | D3DFVF_TEX1, vertices,
                                 3 * count, 0);
}

static void end_picture(void) {
  IDirect3DDevice7_EndScene(device);
}

static void read_picture(DWORD* pixels) {
  copy_rows(target, pixels, PIXELS, 0);
}
