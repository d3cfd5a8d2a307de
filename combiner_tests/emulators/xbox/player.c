/* Plays the push buffer of the kit for an Xbox: an NV2A that has combiners, colours, fog and nearest texels of single
   squares, and no more. Its combiners are ninebit_combiner.c. Every method goes to the file that the variable LOG
   names, as xemu traces it. A method that it does not know, and a setting that it does not model, end the program. */
#include <hal/debug.h>
#include <hal/video.h>
#include <math.h>
#include <nxdk/mount.h>
#include <pbkit/pbkit.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>
#include <xboxkrnl/xboxkrnl.h>

#include "ninebit_combiner.h"

enum { WIDTH = 640, HEIGHT = 480, UNITS = 4 };
static uint32_t screen[HEIGHT][WIDTH], buffer[1024], registers[0x2000 / 4];
static uint8_t *memory; /* of textures; offset 0 of the chip */
static float attributes[16][4], square[4][16][4];
static int vertices, loaded; /* of the square; words of the vertex program */

/* What is not modelled has one value, which every draw needs. A method of a texture unit is that of unit 0. */
static const struct {
  uint32_t method, value;
} fixed[] = {
    {0x029C, 0x2601},     /* fog is linear */
    {0x02A0, 6},          /* its coordinate is the vertex's */
    {0x02A4, 1},          /* fog is on: its factor is in the register */
    {0x0300, 0},          /* no alpha test */
    {0x0304, 0},          /* no blending */
    {0x0308, 0},          /* no culling */
    {0x030C, 0},          /* no depth test */
    {0x0310, 0},          /* no dither */
    {0x0314, 0},          /* no lighting */
    {0x0328, 0},          /* no skinning */
    {0x032C, 0},          /* no stencil test */
    {0x0358, 0x01010101}, /* all components are written */
    {0x035C, 0},          /* and no depth */
    {0x037C, 0x1D00},     /* flat */
    {0x03B8, 1},          /* the secondary colour is the vertex's */
    {0x09C8, 0},          /* the third number of the fog's */
    {0x17BC, 0},          /* no logic operation */
    {0x17F8, 0},          /* no clip planes */
    {0x1B04, 0x0001122A}, /* 2D, one level, linear A8R8G8B8 */
    {0x1B08, 0x00030303}, /* clamped to the edge */
    {0x1B10, 64u << 16},  /* bytes a row */
    {0x1B1C, 16u << 16 | 1},
    {0x1E78, 0},  /* no stage reads another one's texel */
    {0x1E94, 6},  /* a vertex program, private */
    {0x1E98, 0},  /* that cannot write constants */
    {0x1E9C, 0},  /* its first instruction goes to slot 0 */
    {0x1EA0, 0}}; /* where it starts */
enum { FIXED = sizeof fixed / sizeof fixed[0] };
static bool is_set[0x2000 / 4];

/* Ranges of methods whose values are modelled, with the first that is none of them. */
static const uint32_t modelled[][2] = {{0x0260, 0x0280}, {0x0288, 0x0290}, {0x02A8, 0x02AC}, {0x09C0, 0x09C8},
                                       {0x0A60, 0x0AE0}, {0x1E20, 0x1E28}, {0x1E40, 0x1E64}, {0x1E70, 0x1E74},
                                       {0x17FC, 0x1800}, {0x1A00, 0x1B00}, {0x1B00, 0x1B04}, {0x1B0C, 0x1B10},
                                       {0x1B14, 0x1B18}};

/* The vertex program: MOV of an attribute to an output, for each output that has a meaning here. */
static const uint32_t moves[8][4] = {
    {0, 0x0020001B, 0x0836106C, 0x2070F800},  /* position */
    {0, 0x0020061B, 0x0836106C, 0x2070F818},  /* primary colour: attribute 3 */
    {0, 0x0020081B, 0x0836106C, 0x2070F820},  /* secondary colour: 4 */
    {0, 0x00200A1B, 0x0836106C, 0x2070F828},  /* fog: 5 */
    {0, 0x0020121B, 0x0836106C, 0x2070F848},  /* texture coordinates: 9 to 12 */
    {0, 0x0020141B, 0x0836106C, 0x2070F850},
    {0, 0x0020161B, 0x0836106C, 0x2070F858},
    {0, 0x0020181B, 0x0836106C, 0x2070F861}}; /* the last one ends the program */
static FILE *trace;

static void fail(const char *what, uint32_t method, uint32_t value) {
  fprintf(stderr, "player: %s: method 0x%04X, 0x%08X\n", what, (unsigned)method, (unsigned)value);
  exit(3);
}

static uint32_t reg(uint32_t method) { return registers[method / 4]; }

static float number_of(uint32_t bits) {
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

static uint8_t byte_of(float color) { return (uint8_t)(color * 255.0f + 0.5f); }

/* Rule 25: cut to 12 bits, of which 255 (n + 1) / 4096 is the byte. */
static uint8_t fog_byte(float x) {
  const float factor = number_of(reg(0x09C0)) - 1.0f + number_of(reg(0x09C4)) * x;
  const int n = (int)floorf(4096.0f * factor);
  return (uint8_t)(255 * ((n < 0 ? 0 : n > 4095 ? 4095 : n) + 1) >> 12);
}

static void read_words(nbc_words *words) {
  int i;
  for (i = 0; i < 8; ++i) {
    const uint32_t at = 4 * (uint32_t)i;
    words->in_alpha[i] = reg(0x0260 + at);
    words->out_alpha[i] = reg(0x0AA0 + at);
    words->in_rgb[i] = reg(0x0AC0 + at);
    words->out_rgb[i] = reg(0x1E40 + at);
    words->stage_color0[i] = reg(0x0A60 + at);
    words->stage_color1[i] = reg(0x0A80 + at);
  }
  for (i = 0; i < 2; ++i) words->color[i] = reg(0x1E20 + 4 * (uint32_t)i);
  words->final0 = reg(0x0288);
  words->final1 = reg(0x028C);
  words->enable = reg(0x1E60);
}

static void read_texel(int unit, int16_t codes[4]) {
  static const int shifts[4] = {16, 8, 0, 24};
  const uint32_t at = 64 * (uint32_t)unit, filter = reg(0x1B14 + at);
  const int is_on = (reg(0x1B0C + at) >> 30 & 1) != 0 && (reg(0x1E70) >> (5 * unit) & 31) == 1;
  uint32_t texel;
  int i;
  if (!is_on) {
    codes[NBC_ALPHA] = 255;
    return;
  }
  if ((filter >> 16 & 0xFFF) != 0x101) fail("a filter that is not modelled", 0x1B14 + at, filter);
  memcpy(&texel, memory + reg(0x1B00 + at) + 4 * (unsigned)attributes[9 + unit][0], sizeof texel);
  for (i = 0; i < 4; ++i) {
    const uint8_t byte = (uint8_t)(texel >> shifts[i]);
    codes[i] = (int16_t)(filter >> 28 ? 2 * (int8_t)byte : byte);
  }
}

/* Draws the square of four equal vertices. */
static void draw(void) {
  int16_t codes[NBC_REGISTERS][4] = {{0}}, color[4];
  nbc_words words;
  nbc_state state;
  nbc_program program;
  uint32_t pixel;
  int i, x, y;
  for (i = 1; i < 4; ++i) {
    if (memcmp(square[0][1], square[i][1], sizeof square[0] - sizeof square[0][0]) != 0) fail("corners differ", 0, 0);
  }
  read_words(&words);
  if (!nbc_read_words(&words, NBC_NV20, &state) || !nbc_compile(&state, nbc_find_profile("nv2a"), &program)) {
    fail("words that are not a program", 0x1E60, words.enable);
  }
  for (i = 0; i < 4; ++i) {
    codes[NBC_PRIMARY][i] = byte_of(attributes[3][i]);
    codes[NBC_SECONDARY][i] = byte_of(attributes[4][i]);
    codes[NBC_FOG][i] = i == NBC_ALPHA ? fog_byte(attributes[5][0]) : (int16_t)(reg(0x02A8) >> (8 * i) & 255);
    read_texel(i, codes[NBC_TEXTURE0 + i]);
  }
  codes[NBC_SPARE0][NBC_ALPHA] = codes[NBC_TEXTURE0][NBC_ALPHA];
  nbc_evaluate(&program, codes, color);
  pixel = (uint32_t)color[3] << 24 | (uint32_t)color[0] << 16 | (uint32_t)color[1] << 8 | (uint32_t)color[2];
  for (y = (int)square[0][0][1]; y < (int)square[2][0][1]; ++y) {
    for (x = (int)square[0][0][0]; x < (int)square[2][0][0]; ++x) screen[y][x] = pixel;
  }
}

/* The methods of texture units 1 to 3 as those of unit 0. */
static uint32_t of_unit0(uint32_t method) {
  return method >= 0x1B00 && method < 0x1B00 + 64 * UNITS ? 0x1B00 + method % 64 : method;
}

static void check_setting(uint32_t method, uint32_t value) {
  const uint32_t general = of_unit0(method);
  size_t i;
  if (method >= 0x0B00 && method < 0x0B80) {
    if (loaded == 32 || value != moves[loaded / 4][loaded % 4]) fail("not the vertex program", method, value);
    return;
  }
  for (i = 0; i < FIXED; ++i) {
    if (fixed[i].method != general) continue;
    if (fixed[i].value != value) fail("a setting that is not modelled", method, value);
    return;
  }
  for (i = 0; i < sizeof modelled / sizeof modelled[0]; ++i) {
    if (general >= modelled[i][0] && general < modelled[i][1]) return;
  }
  fail("a method that is not known", method, value);
}

/* Before a draw: all that is not modelled was set. */
static void check_all_set(void) {
  int i, unit;
  for (i = 0; i < FIXED; ++i) {
    const int units = fixed[i].method >= 0x1B00 && fixed[i].method < 0x1B40 ? UNITS : 1;
    for (unit = 0; unit < units; ++unit) {
      const uint32_t method = fixed[i].method + 64 * (uint32_t)unit;
      if (!is_set[method / 4]) fail("a setting that nobody made", method, fixed[i].value);
    }
  }
  if (loaded != 32) fail("words of the vertex program", 0x0B00, (uint32_t)loaded);
}

static void write_register(uint32_t method, uint32_t value) {
  if (trace != NULL && method != 0x1E70) {
    fprintf(trace, "nv2a_pgraph_method 0: 0x97 -> 0x%04x NV097_METHOD[0] 0x%x\n", (unsigned)method, (unsigned)value);
  } else if (trace != NULL) {
    fprintf(trace, "nv2a_pgraph_method 0: 0x97 -> 0x1e70 NV097_SET_SHADER_STAGE_PROGRAM[0] 0x%x\n", (unsigned)value);
  }
  check_setting(method, value);
  registers[method / 4] = value;
  is_set[method / 4] = true;
  if (method >= 0x0B00 && method < 0x0B80) {
    loaded += 1;
    return;
  }
  if (method >= 0x1A00 && method < 0x1B00) {
    const uint32_t attribute = (method - 0x1A00) / 16, component = (method - 0x1A00) / 4 % 4;
    attributes[attribute][component] = number_of(value);
    if (attribute == 0 && component == 3) {
      if (vertices == 4) fail("a fifth corner", method, value);
      memcpy(square[vertices++], attributes, sizeof attributes);
    }
    return;
  }
  if (method != 0x17FC) return;
  if (value == 0 && vertices != 4) fail("not four corners", method, (uint32_t)vertices);
  if (value == 0) draw();
  if (value != 0 && value != 8) fail("a draw that is not modelled", method, value);
  if (value != 0) check_all_set();
  vertices = 0;
}

int pb_init(void) {
  const char *const name = getenv("LOG");
  trace = name == NULL ? NULL : fopen(name, "w");
  return 0;
}
void pb_kill(void) {
  if (trace != NULL) fclose(trace);
}
void pb_show_front_screen(void) {}
void pb_show_debug_screen(void) {}
unsigned pb_wait_for_vbl(void) { return 0; }
void pb_reset(void) {}
void pb_target_back_buffer(void) {}
void pb_fill(int x, int y, int width, int height, unsigned color) {
  int i, k;
  for (k = y; k < y + height; ++k) {
    for (i = x; i < x + width; ++i) screen[k][i] = color;
  }
}
int pb_busy(void) { return 0; }
int pb_finished(void) { return 0; }
uint32_t *pb_begin(void) { return buffer; }
/* The header of a run of methods: how many words follow, and the first method. */
void pb_push(uint32_t *p, uint32_t command, uint32_t count) { *p = count << 18 | command; }
void pb_push1(uint32_t *p, uint32_t command, uint32_t value) {
  pb_push(p, command, 1);
  p[1] = value;
}
void pb_end(uint32_t *end) {
  const uint32_t *p = buffer;
  while (p < end) {
    uint32_t method = *p & 0x1FFC, count = *p >> 18 & 0x7FF;
    if ((*p & 0xE003E003u) != 0) fail("not a header", *p, 0);
    for (++p; count > 0; --count, method += 4) write_register(method, *p++);
  }
  if (p != end) fail("a run goes past the end", 0, 0);
}
uint32_t *pb_back_buffer(void) { return screen[0]; }
unsigned pb_back_buffer_pitch(void) { return sizeof screen[0]; }

int XVideoSetMode(int width, int height, int bits, int refresh) {
  return width == WIDTH && height == HEIGHT && bits == 32 && refresh == REFRESH_DEFAULT;
}
void debugPrint(const char *format, ...) {
  va_list values;
  va_start(values, format);
  vprintf(format, values);
  va_end(values);
}
bool nxIsDriveMounted(char letter) { return letter != 'E'; }
bool nxMountDrive(char letter, const char *path) {
  return letter == 'E' && strcmp(path, "\\Device\\Harddisk0\\Partition1\\") == 0;
}
void Sleep(unsigned milliseconds) { (void)milliseconds; }
/* The kit masks addresses to what the chip sees; so the memory must begin where the masked address is known. */
void *MmAllocateContiguousMemoryEx(unsigned bytes, unsigned lowest, unsigned highest, unsigned alignment,
                                   unsigned protection) {
  uint8_t *const all = malloc(2 * 0x04000000u);
  (void)lowest;
  (void)highest;
  (void)alignment;
  if (all == NULL || bytes > 0x04000000u || protection != 0x404) return NULL;
  memory = all + (0x04000000u - (uintptr_t)all % 0x04000000u) % 0x04000000u;
  return memory;
}
