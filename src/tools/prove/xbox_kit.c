/* Runs small register combiner programs on the Xbox's NV2A and writes what they show to its hard disk. */
#include <hal/debug.h>
#include <hal/video.h>
#include <hal/xbox.h>
#include <nxdk/mount.h>
#include <pbkit/pbkit.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <windows.h>
#include <xboxkrnl/xboxkrnl.h>

#ifndef DRIVE
#define DRIVE "E:\\" /* where the two tables go */
#endif

/* Methods of the NV2A's 3D class, NV097. */
enum {
  SET_FOG_MODE = 0x029C,
  SET_FOG_GEN_MODE = 0x02A0,
  SET_FOG_ENABLE = 0x02A4,
  SET_FOG_COLOR = 0x02A8,
  SET_ALPHA_TEST_ENABLE = 0x0300,
  SET_BLEND_ENABLE = 0x0304,
  SET_CULL_FACE_ENABLE = 0x0308,
  SET_DEPTH_TEST_ENABLE = 0x030C,
  SET_DITHER_ENABLE = 0x0310,
  SET_LIGHTING_ENABLE = 0x0314,
  SET_SKIN_MODE = 0x0328,
  SET_STENCIL_TEST_ENABLE = 0x032C,
  SET_COLOR_MASK = 0x0358,
  SET_DEPTH_MASK = 0x035C,
  SET_SHADE_MODE = 0x037C,
  SET_SPECULAR_ENABLE = 0x03B8,
  SET_FOG_PARAMS = 0x09C0,
  SET_TRANSFORM_PROGRAM = 0x0B00,
  SET_LOGIC_OP_ENABLE = 0x17BC,
  SET_SHADER_CLIP_PLANE_MODE = 0x17F8,
  SET_BEGIN_END = 0x17FC,
  SET_VERTEX_DATA4F = 0x1A00,
  SET_TEXTURE_OFFSET = 0x1B00,
  SET_TEXTURE_FORMAT = 0x1B04,
  SET_TEXTURE_ADDRESS = 0x1B08,
  SET_TEXTURE_CONTROL0 = 0x1B0C,
  SET_TEXTURE_CONTROL1 = 0x1B10,
  SET_TEXTURE_FILTER = 0x1B14,
  SET_TEXTURE_IMAGE_RECT = 0x1B1C,
  SET_SHADER_STAGE_PROGRAM = 0x1E70,
  SET_SHADER_OTHER_STAGE_INPUT = 0x1E78,
  SET_TRANSFORM_EXECUTION_MODE = 0x1E94,
  SET_TRANSFORM_PROGRAM_CXT_WRITE_EN = 0x1E98,
  SET_TRANSFORM_PROGRAM_LOAD = 0x1E9C,
  SET_TRANSFORM_PROGRAM_START = 0x1EA0
};
/* Vertex attributes. */
enum { POSITION = 0, DIFFUSE = 3, SPECULAR = 4, FOG_COORDINATE = 5, TEXTURE0 = 9 };
/* Registers of an input, 4 codes each. */
enum { FOG, PRIMARY, SECONDARY, SPARE0, SPARE1, UNIT0, CODES = 36 };
enum { UNITS = 4, MOST_FRAGMENTS = 16, CELL = 16, UNIT_BYTES = 256 };

/* A register's word that is not 0. */
typedef struct {
  uint8_t word; /* its place in `methods` */
  uint32_t value;
} Setting;

/* A program and its fragments. */
typedef struct {
  const char *row; /* of the kit: its line in the table, without the colour; NULL: of the pack */
  uint16_t number; /* of the pack, from 1 */
  uint16_t first_setting, settings, first_input, fragments;
  int8_t unit_off; /* a texture unit that is off; -1: none */
} Program;

/* ROWS: the programs and their inputs */

static uint32_t *texels[UNITS]; /* a row of MOST_FRAGMENTS texels, A8R8G8B8 */

static void send(uint32_t method, uint32_t value) {
  uint32_t *p = pb_begin();
  pb_push1(p, method, value);
  p += 2;
  pb_end(p);
}

static uint32_t bits_of(float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}

/* Sets a vertex attribute. The position comes last: it makes a vertex of all of them. */
static void send_attribute(uint32_t attribute, float x, float y, float z, float w) {
  const uint32_t method = SET_VERTEX_DATA4F + 16 * attribute;
  send(method, bits_of(x));
  send(method + 4, bits_of(y));
  send(method + 8, bits_of(z));
  send(method + 12, bits_of(w));
}

/* Loads a vertex program that moves the attributes to outputs as they are: positions are pixels of the surface. */
static void load_vertex_program(void) {
  /* attribute, output: position, both colours, fog, four texture coordinates */
  static const uint8_t moves[][2] = {{POSITION, 0},      {DIFFUSE, 3},       {SPECULAR, 4},      {FOG_COORDINATE, 5},
                                     {TEXTURE0, 9},      {TEXTURE0 + 1, 10}, {TEXTURE0 + 2, 11}, {TEXTURE0 + 3, 12}};
  enum { MOVES = sizeof moves / sizeof moves[0], XYZW = 0x1B };
  int i;
  send(SET_TRANSFORM_PROGRAM_START, 0);
  send(SET_TRANSFORM_EXECUTION_MODE, 2 | 1 << 2); /* a program, private */
  send(SET_TRANSFORM_PROGRAM_CXT_WRITE_EN, 0);
  send(SET_TRANSFORM_PROGRAM_LOAD, 0);
  for (i = 0; i < MOVES; ++i) {
    uint32_t *p = pb_begin();
    pb_push(p++, SET_TRANSFORM_PROGRAM, 4);
    *p++ = 0;
    *p++ = 1u << 21 | (uint32_t)moves[i][0] << 9 | XYZW;                       /* MOV of an input */
    *p++ = 2u << 26 | XYZW << 17 | 2u << 11 | XYZW << 2;                       /* A and B are the input */
    *p++ = 2u << 28 | 7u << 20 | 15u << 12 | 1u << 11 | (uint32_t)moves[i][1] << 3 | (i == MOVES - 1); /* the output */
    pb_end(p);
  }
}

/* Everything but combiners that decides a pixel. */
static void send_state(void) {
  int unit;
  send(SET_ALPHA_TEST_ENABLE, 0);
  send(SET_BLEND_ENABLE, 0);
  send(SET_CULL_FACE_ENABLE, 0);
  send(SET_DEPTH_TEST_ENABLE, 0);
  send(SET_DITHER_ENABLE, 0);
  send(SET_LIGHTING_ENABLE, 0);
  send(SET_SKIN_MODE, 0);
  send(SET_STENCIL_TEST_ENABLE, 0);
  send(SET_LOGIC_OP_ENABLE, 0);
  send(SET_COLOR_MASK, 0x01010101);
  send(SET_DEPTH_MASK, 0);
  send(SET_SHADE_MODE, 0x1D00); /* flat */
  send(SET_SPECULAR_ENABLE, 1);
  /* The factor is the vertex's fog coordinate: bias - 1 + 1 x. */
  send(SET_FOG_MODE, 0x2601);
  send(SET_FOG_GEN_MODE, 6);
  send(SET_FOG_PARAMS, bits_of(1.0f));
  send(SET_FOG_PARAMS + 4, bits_of(1.0f));
  send(SET_FOG_PARAMS + 8, bits_of(0.0f));
  send(SET_FOG_ENABLE, 1);
  send(SET_SHADER_CLIP_PLANE_MODE, 0);
  send(SET_SHADER_OTHER_STAGE_INPUT, 0);
  for (unit = 0; unit < UNITS; ++unit) {
    const uint32_t at = 64 * (uint32_t)unit;
    send(SET_TEXTURE_OFFSET + at, (uint32_t)(uintptr_t)texels[unit] & 0x03FFFFFF);
    send(SET_TEXTURE_FORMAT + at, 0x0001122A); /* 2D, one level, linear A8R8G8B8 */
    send(SET_TEXTURE_ADDRESS + at, 0x00030303);
    send(SET_TEXTURE_CONTROL1 + at, 4 * MOST_FRAGMENTS << 16); /* bytes a row */
    send(SET_TEXTURE_IMAGE_RECT + at, MOST_FRAGMENTS << 16 | 1);
  }
}

static void send_program(const Program *program) {
  uint32_t stages = 0;
  int i, unit;
  for (i = 0; i < WORDS; ++i) {
    uint32_t value = 0;
    int k;
    for (k = 0; k < program->settings; ++k) {
      const Setting *const setting = &settings[program->first_setting + k];
      if (setting->word == i) value = setting->value;
    }
    send(methods[i], value);
  }
  for (unit = 0; unit < UNITS; ++unit) {
    const int is_on = unit != program->unit_off;
    if (is_on) stages |= 1u << (5 * unit); /* a 2D texture */
    send(SET_TEXTURE_CONTROL0 + 64 * (uint32_t)unit, is_on ? 0x4003FFC0 : 0);
  }
  send(SET_SHADER_STAGE_PROGRAM, stages);
}

/* The input's texel of a unit as a word, and whether it is signed: a signed byte s is the code 2s. */
static uint32_t texel_of(const int16_t *codes, int *is_signed) {
  static const int shifts[4] = {16, 8, 0, 24};
  uint32_t word = 0;
  int i;
  *is_signed = codes[0] < 0 || codes[1] < 0 || codes[2] < 0 || codes[3] < 0;
  for (i = 0; i < 4; ++i) word |= (uint32_t)((*is_signed ? codes[i] / 2 : codes[i]) & 255) << shifts[i];
  return word;
}

static void send_color(uint32_t attribute, const int16_t *codes) {
  send_attribute(attribute, (float)codes[0] / 255.0f, (float)codes[1] / 255.0f, (float)codes[2] / 255.0f,
                 (float)codes[3] / 255.0f);
}

/* A coordinate that becomes the byte: cut to 12 bits n, a fog factor is 255 (n + 1) / 4096. */
static float fog_coordinate(int byte) {
  const int n = byte == 0 ? 0 : (4096 * byte + 254) / 255 - 1;
  return ((float)n + 0.5f) / 4096.0f;
}

/* Draws a square with an input's values, in a cell of its own. */
static void draw(const int16_t *input, int fragment) {
  static const int corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const float left = (float)(CELL * fragment);
  int i, unit;
  for (unit = 0; unit < UNITS; ++unit) {
    int is_signed;
    (void)texel_of(input + 4 * (UNIT0 + unit), &is_signed);
    /* nearest texels; the four highest bits say which components are signed */
    send(SET_TEXTURE_FILTER + 64 * (uint32_t)unit, 0x01012000u | (is_signed ? 0xF0000000u : 0));
  }
  send(SET_FOG_COLOR, (uint32_t)input[0] | (uint32_t)input[1] << 8 | (uint32_t)input[2] << 16 | 0xFF000000u);
  send(SET_BEGIN_END, 8); /* quads */
  for (i = 0; i < 4; ++i) {
    send_color(DIFFUSE, input + 4 * PRIMARY);
    send_color(SPECULAR, input + 4 * SECONDARY);
    send_attribute(FOG_COORDINATE, fog_coordinate(input[3]), 0.0f, 0.0f, 1.0f);
    for (unit = 0; unit < UNITS; ++unit) {
      send_attribute((uint32_t)(TEXTURE0 + unit), (float)fragment + 0.5f, 0.5f, 0.0f, 1.0f);
    }
    send_attribute(POSITION, left + (float)(CELL * corners[i][0]), (float)(CELL * corners[i][1]), 1.0f, 1.0f);
  }
  send(SET_BEGIN_END, 0);
}

/* Runs a program over its fragments and reads a pixel in the middle of each cell, as 0xAARRGGBB. */
static void run(const Program *program, uint32_t shown[MOST_FRAGMENTS]) {
  int i, unit;
  for (i = 0; i < program->fragments; ++i) {
    for (unit = 0; unit < UNITS; ++unit) {
      int is_signed;
      texels[unit][i] = texel_of(inputs[program->first_input + i] + 4 * (UNIT0 + unit), &is_signed);
    }
  }
  pb_wait_for_vbl();
  pb_reset();
  pb_target_back_buffer();
  pb_fill(0, 0, CELL * MOST_FRAGMENTS, CELL, 0x80808080);
  send_state();
  send_program(program);
  for (i = 0; i < program->fragments; ++i) draw(inputs[program->first_input + i], i);
  while (pb_busy()) {
  }
  for (i = 0; i < program->fragments; ++i) {
    const uint8_t *const row = (const uint8_t *)pb_back_buffer() + CELL / 2 * pb_back_buffer_pitch();
    memcpy(&shown[i], row + 4 * (CELL * i + CELL / 2), sizeof shown[i]);
  }
  while (pb_finished()) {
  }
}

/* Returns what failed, or NULL. */
static const char *run_all(void) {
  FILE *kit, *pack;
  int i, k, is_written;
  kit = fopen(DRIVE "ninebit_kit.csv", "w");
  pack = fopen(DRIVE "ninebit_pack.txt", "w");
  if (kit == NULL || pack == NULL) return "cannot write to " DRIVE;
  fprintf(kit, "# family: nv2a\n# renderer: NV2A of an Xbox\n%s\n", HEADER);
  fprintf(pack, "ninebit-results 1 %s\n", PACK);
  for (i = 0; i < PROGRAMS; ++i) {
    const Program *const program = &programs[i];
    uint32_t shown[MOST_FRAGMENTS];
    run(program, shown);
    if (program->row != NULL) {
      fprintf(kit, "%s%u,%u,%u\n", program->row, (unsigned)(shown[0] >> 16 & 255), (unsigned)(shown[0] >> 8 & 255),
              (unsigned)(shown[0] & 255));
      continue;
    }
    fprintf(pack, "%u", (unsigned)program->number);
    for (k = 0; k < program->fragments; ++k) {
      fprintf(pack, " %06X%02X", (unsigned)(shown[k] & 0xFFFFFF), (unsigned)(shown[k] >> 24));
    }
    fprintf(pack, "\n");
  }
  is_written = !ferror(kit) && !ferror(pack);
  is_written = fclose(kit) == 0 && is_written;
  is_written = fclose(pack) == 0 && is_written;
  return is_written ? NULL : "cannot write to " DRIVE;
}

/* Prepares the machine. Returns what failed, or NULL. */
static const char *prepare(void) {
  enum { READ_WRITE_COMBINED = 0x404 };
  uint8_t *memory;
  int unit;
  if (!nxIsDriveMounted('E') && !nxMountDrive('E', "\\Device\\Harddisk0\\Partition1\\")) return "cannot mount drive E";
  if (pb_init() != 0) return "cannot start the graphics processor";
  memory = MmAllocateContiguousMemoryEx(UNITS * UNIT_BYTES, 0, 0x03FFAFFF, 0, READ_WRITE_COMBINED);
  if (memory == NULL) return "there is no memory for textures";
  for (unit = 0; unit < UNITS; ++unit) texels[unit] = (uint32_t *)(memory + UNIT_BYTES * unit);
  return NULL;
}

int main(void) {
  const char *failed;
  XVideoSetMode(640, 480, 32, REFRESH_DEFAULT);
  failed = prepare();
  if (failed == NULL) {
    pb_show_front_screen();
    load_vertex_program();
    failed = run_all();
    pb_show_debug_screen();
    pb_kill();
  }
  if (failed != NULL) {
    debugPrint("ninebit: %s\n", failed);
  } else {
    debugPrint("ninebit: wrote " DRIVE "ninebit_kit.csv and " DRIVE "ninebit_pack.txt\n");
  }
  Sleep(10000);
  return failed != NULL;
}
