/* A Windows program with Direct3D 7, 8 or 9 and no shader: it draws 256 fragments with each of a few set-ups of texture
 * stages and prints what it reads back. Written without OpenGL. The version's header has the calls that differ.
 *
 *   texture_stages.exe INPUTS.bin > RESULTS.txt
 *
 * INPUTS.bin holds four planes of 256 colours of four bytes, red first: the diffuse colour, one that is not used, the
 * texels of two textures of 16 x 16. Each fragment is a cell of 2 x 2 pixels.
 */
#define COBJMACROS
#include <windows.h>

enum { SIDE = 16, CELL = 2, PIXELS = SIDE * CELL };
enum { CLEAR_COLOR = 0x11223344, FACTOR_COLOR = 0x80c04020 };

typedef struct {
  float x, y, z;
  DWORD color;
  float u, v;
} Corner;

#if DIRECT3D == 7
#include "direct3d7.h"
#elif DIRECT3D == 8
#include "direct3d8.h"
#else
#include "direct3d9.h"
#endif
#include <stdio.h>
#include <string.h>

enum { TEXTURE = D3DTA_TEXTURE, DIFFUSE = D3DTA_DIFFUSE, CURRENT = D3DTA_CURRENT, FACTOR = D3DTA_TFACTOR };

static unsigned char inputs[4][SIDE * SIDE][4];

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
  memset(&type, 0, sizeof type);
  type.lpfnWndProc = DefWindowProcA;
  type.hInstance = GetModuleHandleA(NULL);
  type.lpszClassName = "texture_stages";
  RegisterClassA(&type);
  return make_device(CreateWindowA(type.lpszClassName, "stages", WS_POPUP | WS_VISIBLE, 0, 0, PIXELS, PIXELS, NULL, NULL,
                                   type.hInstance, NULL));
}

static DWORD argb(const unsigned char* rgba) {
  return (DWORD)rgba[3] << 24 | (DWORD)rgba[0] << 16 | (DWORD)rgba[1] << 8 | rgba[2];
}

static void make_textures(void) {
  DWORD unit;
  int i;
  for (unit = 0; unit < 2; ++unit) {
    DWORD texels[SIDE * SIDE];
    for (i = 0; i < SIDE * SIDE; ++i) texels[i] = argb(inputs[2 + unit][i]);
    set_texture(unit, texels);
    set_stage(unit, D3DTSS_TEXCOORDINDEX, 0);
  }
}

static void draw_cells(void) {
  static Corner vertices[SIDE * SIDE * 6];
  static const int corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  Corner* v = vertices;
  int i, corner;
  for (i = 0; i < SIDE * SIDE; ++i) {
    for (corner = 0; corner < 6; ++corner, ++v) {
      v->u = (float)(i % SIDE + corners[corner][0]) / SIDE;
      v->v = (float)(i / SIDE + corners[corner][1]) / SIDE;
      v->x = 2 * v->u - 1 - 1.0f / PIXELS; /* Direct3D before 10 has pixels half a pixel further */
      v->y = 1 - 2 * v->v + 1.0f / PIXELS;
      v->z = 0.5f;
      v->color = argb(inputs[0][i]);
    }
  }
  draw_triangles(vertices, SIDE * SIDE * 2);
}

static void set_portion(DWORD stage, const Portion* portion, int alpha) {
  set_stage(stage, alpha ? D3DTSS_ALPHAOP : D3DTSS_COLOROP, portion->op);
  set_stage(stage, alpha ? D3DTSS_ALPHAARG1 : D3DTSS_COLORARG1, portion->arg1);
  set_stage(stage, alpha ? D3DTSS_ALPHAARG2 : D3DTSS_COLORARG2, portion->arg2);
}

static void draw(const Stages* set) {
  begin_picture();
  set_portion(0, &set->color0, 0);
  set_portion(0, &set->alpha0, 1);
  set_portion(1, &set->color1, 0);
  set_portion(1, &set->alpha1, 1);
  draw_cells();
  end_picture();
}

static void print_picture(const char* name) {
  DWORD pixels[PIXELS * PIXELS];
  int i;
  read_picture(pixels);
  printf("stages %s:\n", name);
  for (i = 0; i < SIDE * SIDE; ++i) {
    DWORD p = pixels[i / SIDE * CELL * PIXELS + i % SIDE * CELL];
    printf("%lu %lu %lu %lu\n", p >> 16 & 255, p >> 8 & 255, p & 255, p >> 24);
  }
}

int main(int argc, char** argv) {
  FILE* file = argc > 1 ? fopen(argv[1], "rb") : NULL;
  size_t i;
  if (!file || fread(inputs, 1, sizeof inputs, file) != sizeof inputs) {
    printf("the inputs cannot be read\n");
    return 1;
  }
  if (!open_window()) {
    printf("there is no Direct3D device\n");
    return 1;
  }
  printf("pixel shaders: %lu\n", pixel_shaders());
  make_textures();
  draw(&sets[0]); /* the first picture settles Wine's state */
  for (i = 0; i < sizeof sets / sizeof *sets; ++i) {
    draw(&sets[i]);
    print_picture(sets[i].name);
  }
  return 0;
}
