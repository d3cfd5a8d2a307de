/* A Windows program with Direct3D 9 and no shader: it draws 256 fragments with each of a few set-ups of texture stages
 * and prints what it reads back. Written without OpenGL.
 *
 *   texture_stages.exe INPUTS.bin > RESULTS.txt
 *
 * INPUTS.bin holds four planes of 256 colours of four bytes, red first: the diffuse colour, one that is not used, the
 * texels of two textures of 16 x 16. Each fragment is a cell of 2 x 2 pixels.
 */
#define COBJMACROS
#include <d3d9.h>
#include <stdio.h>
#include <string.h>

enum { SIDE = 16, CELL = 2, PIXELS = SIDE * CELL };
enum { TEXTURE = D3DTA_TEXTURE, DIFFUSE = D3DTA_DIFFUSE, CURRENT = D3DTA_CURRENT, FACTOR = D3DTA_TFACTOR };

static unsigned char inputs[4][SIDE * SIDE][4];
static IDirect3DDevice9* device;

typedef struct {
  DWORD op, arg1, arg2;
} Portion;

typedef struct {
  const char* name;
  Portion color0, alpha0, color1, alpha1;
} Stages;

#define FROM_TEXTURE \
  { D3DTOP_SELECTARG1, TEXTURE, DIFFUSE }
#define NOTHING \
  { D3DTOP_DISABLE, TEXTURE, CURRENT }

static const Stages sets[] = {
    {"modulate", {D3DTOP_MODULATE, TEXTURE, DIFFUSE}, {D3DTOP_MODULATE, TEXTURE, DIFFUSE}, NOTHING, NOTHING},
    {"modulate2x", {D3DTOP_MODULATE2X, TEXTURE, DIFFUSE}, FROM_TEXTURE, NOTHING, NOTHING},
    {"modulate4x", {D3DTOP_MODULATE4X, TEXTURE, DIFFUSE}, FROM_TEXTURE, NOTHING, NOTHING},
    {"add", {D3DTOP_ADD, TEXTURE, DIFFUSE}, {D3DTOP_ADD, TEXTURE, DIFFUSE}, NOTHING, NOTHING},
    {"addsigned", {D3DTOP_ADDSIGNED, TEXTURE, DIFFUSE}, FROM_TEXTURE, NOTHING, NOTHING},
    {"subtract", {D3DTOP_SUBTRACT, TEXTURE, DIFFUSE}, FROM_TEXTURE, NOTHING, NOTHING},
    {"addsmooth", {D3DTOP_ADDSMOOTH, TEXTURE, DIFFUSE}, FROM_TEXTURE, NOTHING, NOTHING},
    {"blend by texture", {D3DTOP_BLENDTEXTUREALPHA, TEXTURE, DIFFUSE}, FROM_TEXTURE, NOTHING, NOTHING},
    {"blend by diffuse", {D3DTOP_BLENDDIFFUSEALPHA, TEXTURE, DIFFUSE}, FROM_TEXTURE, NOTHING, NOTHING},
    {"factor", {D3DTOP_MODULATE, TEXTURE, FACTOR}, {D3DTOP_MODULATE, DIFFUSE, FACTOR}, NOTHING, NOTHING},
    {"dot3", {D3DTOP_DOTPRODUCT3, TEXTURE, DIFFUSE}, FROM_TEXTURE, NOTHING, NOTHING},
    {"light map",
     {D3DTOP_MODULATE, TEXTURE, DIFFUSE},
     FROM_TEXTURE,
     {D3DTOP_MODULATE2X, TEXTURE, CURRENT},
     {D3DTOP_MODULATE, TEXTURE, CURRENT}},
    {"decal",
     FROM_TEXTURE,
     {D3DTOP_SELECTARG1, DIFFUSE, DIFFUSE},
     {D3DTOP_BLENDCURRENTALPHA, TEXTURE, CURRENT},
     {D3DTOP_ADD, TEXTURE, CURRENT}},
};

static int open_window(void) {
  WNDCLASSA type;
  D3DPRESENT_PARAMETERS parameters;
  IDirect3D9* direct3d = Direct3DCreate9(D3D_SDK_VERSION);
  memset(&type, 0, sizeof type);
  memset(&parameters, 0, sizeof parameters);
  type.lpfnWndProc = DefWindowProcA;
  type.hInstance = GetModuleHandleA(NULL);
  type.lpszClassName = "texture_stages";
  RegisterClassA(&type);
  parameters.Windowed = TRUE;
  parameters.SwapEffect = D3DSWAPEFFECT_DISCARD;
  parameters.BackBufferFormat = D3DFMT_A8R8G8B8;
  parameters.BackBufferWidth = parameters.BackBufferHeight = PIXELS;
  parameters.hDeviceWindow = CreateWindowA(type.lpszClassName, "stages", WS_POPUP | WS_VISIBLE, 0, 0, PIXELS, PIXELS,
                                           NULL, NULL, type.hInstance, NULL);
  return direct3d && SUCCEEDED(IDirect3D9_CreateDevice(direct3d, 0, D3DDEVTYPE_HAL, parameters.hDeviceWindow,
                                                       D3DCREATE_SOFTWARE_VERTEXPROCESSING, &parameters, &device));
}

static DWORD argb(const unsigned char* rgba) {
  return D3DCOLOR_ARGB(rgba[3], rgba[0], rgba[1], rgba[2]);
}

static void make_textures(void) {
  int unit, i;
  for (unit = 0; unit < 2; ++unit) {
    IDirect3DTexture9* texture;
    D3DLOCKED_RECT rows;
    IDirect3DDevice9_CreateTexture(device, SIDE, SIDE, 1, 0, D3DFMT_A8R8G8B8, D3DPOOL_MANAGED, &texture, NULL);
    IDirect3DTexture9_LockRect(texture, 0, &rows, NULL, 0);
    for (i = 0; i < SIDE * SIDE; ++i) {
      ((DWORD*)((char*)rows.pBits + i / SIDE * rows.Pitch))[i % SIDE] = argb(inputs[2 + unit][i]);
    }
    IDirect3DTexture9_UnlockRect(texture, 0);
    IDirect3DDevice9_SetTexture(device, (DWORD)unit, (IDirect3DBaseTexture9*)texture);
    IDirect3DDevice9_SetSamplerState(device, (DWORD)unit, D3DSAMP_MAGFILTER, D3DTEXF_POINT);
    IDirect3DDevice9_SetSamplerState(device, (DWORD)unit, D3DSAMP_MINFILTER, D3DTEXF_POINT);
    IDirect3DDevice9_SetTextureStageState(device, (DWORD)unit, D3DTSS_TEXCOORDINDEX, 0);
  }
}

typedef struct {
  float x, y, z;
  DWORD color;
  float u, v;
} Corner;

static void draw_cells(void) {
  static Corner vertices[SIDE * SIDE * 6];
  static const int corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  Corner* v = vertices;
  int i, corner;
  for (i = 0; i < SIDE * SIDE; ++i) {
    for (corner = 0; corner < 6; ++corner, ++v) {
      v->u = (float)(i % SIDE + corners[corner][0]) / SIDE;
      v->v = (float)(i / SIDE + corners[corner][1]) / SIDE;
      v->x = 2 * v->u - 1 - 1.0f / PIXELS; /* Direct3D 9 has pixels half a pixel further */
      v->y = 1 - 2 * v->v + 1.0f / PIXELS;
      v->z = 0.5f;
      v->color = argb(inputs[0][i]);
    }
  }
  IDirect3DDevice9_SetFVF(device, D3DFVF_XYZ | D3DFVF_DIFFUSE | D3DFVF_TEX1);
  IDirect3DDevice9_DrawPrimitiveUP(device, D3DPT_TRIANGLELIST, SIDE * SIDE * 2, vertices, sizeof *vertices);
}

static void set_portion(DWORD stage, const Portion* portion, int alpha) {
  IDirect3DDevice9_SetTextureStageState(device, stage, alpha ? D3DTSS_ALPHAOP : D3DTSS_COLOROP, portion->op);
  IDirect3DDevice9_SetTextureStageState(device, stage, alpha ? D3DTSS_ALPHAARG1 : D3DTSS_COLORARG1, portion->arg1);
  IDirect3DDevice9_SetTextureStageState(device, stage, alpha ? D3DTSS_ALPHAARG2 : D3DTSS_COLORARG2, portion->arg2);
}

static void draw(const Stages* set) {
  IDirect3DDevice9_Clear(device, 0, NULL, D3DCLEAR_TARGET, 0x11223344, 1, 0);
  IDirect3DDevice9_BeginScene(device);
  IDirect3DDevice9_SetRenderState(device, D3DRS_LIGHTING, FALSE);
  IDirect3DDevice9_SetRenderState(device, D3DRS_ZENABLE, FALSE);
  IDirect3DDevice9_SetRenderState(device, D3DRS_CULLMODE, D3DCULL_NONE);
  IDirect3DDevice9_SetRenderState(device, D3DRS_TEXTUREFACTOR, 0x80c04020);
  set_portion(0, &set->color0, 0);
  set_portion(0, &set->alpha0, 1);
  set_portion(1, &set->color1, 0);
  set_portion(1, &set->alpha1, 1);
  draw_cells();
  IDirect3DDevice9_EndScene(device);
}

static void print_picture(const char* name) {
  IDirect3DSurface9 *target, *copy;
  D3DLOCKED_RECT rows;
  int i;
  IDirect3DDevice9_GetRenderTarget(device, 0, &target);
  IDirect3DDevice9_CreateOffscreenPlainSurface(device, PIXELS, PIXELS, D3DFMT_A8R8G8B8, D3DPOOL_SYSTEMMEM, &copy, NULL);
  IDirect3DDevice9_GetRenderTargetData(device, target, copy);
  IDirect3DSurface9_LockRect(copy, &rows, NULL, D3DLOCK_READONLY);
  printf("stages %s:\n", name);
  for (i = 0; i < SIDE * SIDE; ++i) {
    DWORD p = ((DWORD*)((char*)rows.pBits + i / SIDE * CELL * rows.Pitch))[i % SIDE * CELL];
    printf("%lu %lu %lu %lu\n", p >> 16 & 255, p >> 8 & 255, p & 255, p >> 24);
  }
  IDirect3DSurface9_UnlockRect(copy);
  IDirect3DSurface9_Release(copy);
  IDirect3DSurface9_Release(target);
}

int main(int argc, char** argv) {
  FILE* file = argc > 1 ? fopen(argv[1], "rb") : NULL;
  D3DCAPS9 caps;
  size_t i;
  if (!file || fread(inputs, 1, sizeof inputs, file) != sizeof inputs) {
    printf("the inputs cannot be read\n");
    return 1;
  }
  if (!open_window()) {
    printf("there is no Direct3D device\n");
    return 1;
  }
  IDirect3DDevice9_GetDeviceCaps(device, &caps);
  printf("pixel shaders: %lu.%lu\n", caps.PixelShaderVersion >> 8 & 255, caps.PixelShaderVersion & 255);
  make_textures();
  draw(&sets[0]); /* the first picture settles Wine's state */
  for (i = 0; i < sizeof sets / sizeof *sets; ++i) {
    draw(&sets[i]);
    print_picture(sets[i].name);
  }
  return 0;
}
