/* The register combiners of an emulator of the Xbox: what `ninebit vectors --profile nv2a` checks. A register holds a
   number of 255ths. The lines below say how it computes; the page checking-an-emulator.md finds what is wrong in them. */
#include <stdint.h>
#include <string.h>

#ifndef ROUNDS
#define ROUNDS 0 /* whether a register keeps whole 255ths */
#endif
#ifndef HALF
#define HALF 127.5 /* one half */
#endif
#ifndef CLAMPS_NEGATIVE
#define CLAMPS_NEGATIVE 1 /* whether mappings take a negative register as 0 */
#endif
#ifndef MUX_BY_MSB
#define MUX_BY_MSB(control) 1 /* whether the mux looks at the most significant bit, by the control word */
#endif

enum { CONST0 = 1, CONST1 = 2, SECONDARY = 5, TEX0 = 8, SPARE0 = 12, COLOR_SUM = 14, E_TIMES_F = 15 };
enum { ENABLE, FINAL0, FINAL1, COLOR0, COLOR1, STAGES };            /* words of the whole program */
enum { IN_RGB, OUT_RGB, IN_ALPHA, OUT_ALPHA, STAGE0, STAGE1, EACH }; /* words of a stage */

static double registers[16][4];

static double clamp(double v, double low, double high) { return v < low ? low : v > high ? high : v; }
static double nearest(double v) { return (double)((long)(v + 4096.5) - 4096); }

/* What a register keeps of a value in 255 x 255ths. */
static double stored(double wide) {
  const double v = ROUNDS ? nearest(wide / 255) : wide / 255;
  return clamp(v, -255, 255);
}

/* An input: its byte has the register, the alpha bit and the mapping. `component` is read without the alpha bit. */
static double input(unsigned byte, int component) {
  const double v = registers[byte & 15][byte >> 4 & 1 ? 3 : component];
  const double positive = CLAMPS_NEGATIVE && v < 0 ? 0 : v;
  switch (byte >> 5 & 7) {
    case 0: return positive;
    case 1: return 255 - (positive > 255 ? 255 : positive);
    case 2: return 2 * positive - 255;
    case 3: return 255 - 2 * positive;
    case 4: return positive - HALF;
    case 5: return HALF - positive;
    case 6: return v;
    default: return -v;
  }
}

static void load_color(int to, uint32_t argb) {
  registers[to][0] = argb >> 16 & 255;
  registers[to][1] = argb >> 8 & 255;
  registers[to][2] = argb & 255;
  registers[to][3] = argb >> 24;
}

/* What a portion writes: AB, CD and the third output. */
typedef struct {
  double value[3][4];
} Outputs;

/* Channels `first` to `end` - 1 are an RGB portion's 0 to 2, or an alpha portion's 3. */
static void compute(uint32_t in, uint32_t out, uint32_t control, int first, int end, Outputs *to) {
  double wide[3][4];
  int c, k;
  (void)control; /* a MUX_BY_MSB may not use it */
  for (c = first; c < end; ++c) {
    const int component = c == 3 ? 2 : c; /* an alpha portion reads blue without the alpha bit */
    wide[0][c] = input(in >> 24, component) * input(in >> 16, component);
    wide[1][c] = input(in >> 8, component) * input(in, component);
  }
  for (k = 0; k < 2; ++k) {
    if (out >> (13 - k) & 1) wide[k][0] = wide[k][1] = wide[k][2] = wide[k][0] + wide[k][1] + wide[k][2];
  }
  for (c = first; c < end; ++c) {
    const double alpha = registers[SPARE0][3];
    const int takes_cd = MUX_BY_MSB(control) ? alpha >= HALF : alpha > 0 && (long)nearest(alpha) % 2 == 1;
    wide[2][c] = out >> 14 & 1 ? wide[takes_cd][c] : wide[0][c] + wide[1][c];
    for (k = 0; k < 3; ++k) {
      static const double scales[] = {1, 2, 4, 0.5};
      to->value[k][c] = stored((wide[k][c] - (out >> 15 & 1 ? HALF * 255 : 0)) * scales[out >> 16 & 3]);
    }
  }
}

static void write_outputs(uint32_t out, int first, int end, const Outputs *from) {
  const int to[3] = {(int)(out >> 4 & 15), (int)(out & 15), (int)(out >> 8 & 15)};
  int c, k;
  for (k = 0; k < 3; ++k) {
    for (c = first; to[k] != 0 && c < end; ++c) registers[to[k]][c] = from->value[k][c];
  }
  if (first == 3) return;
  if (out >> 19 & 1 && to[0] != 0) registers[to[0]][3] = from->value[0][2];
  if (out >> 18 & 1 && to[1] != 0) registers[to[1]][3] = from->value[1][2];
}

/* Runs the first stages of a program. */
static void run(const uint32_t words[], const int16_t in[], int stages) {
  static const int order[] = {3, 4, 5, 12, 13, 8, 9, 10, 11}; /* of the registers in `in` */
  int i, s;
  memset(registers, 0, sizeof registers);
  for (i = 0; i < 36; ++i) registers[order[i / 4]][i % 4] = in[i];
  for (s = 0; s < stages; ++s) {
    const uint32_t *const word = words + STAGES + EACH * s;
    Outputs rgb, alpha;
    load_color(CONST0, words[STAGES + (words[ENABLE] >> 12 & 1 ? EACH * s : 0) + STAGE0]);
    load_color(CONST1, words[STAGES + (words[ENABLE] >> 16 & 1 ? EACH * s : 0) + STAGE1]);
    compute(word[IN_RGB], word[OUT_RGB], words[ENABLE], 0, 3, &rgb);
    compute(word[IN_ALPHA], word[OUT_ALPHA], words[ENABLE], 3, 4, &alpha);
    write_outputs(word[OUT_RGB], 0, 3, &rgb);
    write_outputs(word[OUT_ALPHA], 3, 4, &alpha);
  }
}

static double color_sum_part(double v, int inverted) {
  const double positive = CLAMPS_NEGATIVE && v < 0 ? 0 : v;
  return inverted ? 255 - positive : positive;
}

void combine(const uint32_t words[], const int16_t in[], uint8_t out[4]);
void combine(const uint32_t words[], const int16_t in[], uint8_t out[4]) {
  const int has_final = words[FINAL0] != 0 || words[FINAL1] != 0; /* without one, spare0 is shown */
  const uint32_t abcd = has_final ? words[FINAL0] : SPARE0, efg = has_final ? words[FINAL1] : (SPARE0 | 16) << 8;
  int c;
  run(words, in, (int)(words[ENABLE] & 15));
  load_color(CONST0, words[COLOR0]);
  load_color(CONST1, words[COLOR1]);
  for (c = 0; c < 3; ++c) {
    const double product = input(efg >> 24, c) * input(efg >> 16, c) / 255;
    const double sum = color_sum_part(registers[SPARE0][c], efg >> 5 & 1) +
                       color_sum_part(registers[SECONDARY][c], efg >> 6 & 1);
    registers[E_TIMES_F][c] = ROUNDS ? nearest(product) : product;
    registers[COLOR_SUM][c] = efg >> 7 & 1 && sum > 255 ? 255 : sum;
  }
  for (c = 0; c < 3; ++c) {
    const double a = input(abcd >> 24, c);
    const double mix = (a * input(abcd >> 16, c) + (255 - a) * input(abcd >> 8, c)) / 255;
    out[c] = (uint8_t)clamp(nearest((ROUNDS ? nearest(mix) : mix) + input(abcd, c)), 0, 255);
  }
  out[3] = (uint8_t)clamp(nearest(input(efg >> 8, 2)), 0, 255);
}

/* For the runner's -DCOMBINE_STAGE. */
void combine_stage(const uint32_t words[], const int16_t in[], int stage, int16_t out[36]);
void combine_stage(const uint32_t words[], const int16_t in[], int stage, int16_t out[36]) {
  static const int order[] = {3, 4, 5, 12, 13, 8, 9, 10, 11};
  int i;
  run(words, in, stage + 1);
  for (i = 0; i < 36; ++i) out[i] = (int16_t)nearest(registers[order[i / 4]][i % 4]);
}
