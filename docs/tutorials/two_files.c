/* The function that runner.c of `ninebit vectors --profile nv2a` calls, by ninebit_combiner.h and ninebit_combiner.c. */
#include "ninebit_combiner.h"

enum { ENABLE, FINAL0, FINAL1, COLOR0, COLOR1, STAGES };                           /* words of the whole program */
enum { IN_RGB, OUT_RGB, IN_ALPHA, OUT_ALPHA, STAGE_COLOR0, STAGE_COLOR1, EACH }; /* words of a stage */

/* Makes a program of the words, and the registers before its first stage of the codes. false: the words are not one. */
static bool start(const uint32_t words[], const int16_t in[], nbc_program *program,
                  int16_t registers[NBC_REGISTERS][4]) {
  static const int order[] = {NBC_FOG,      NBC_PRIMARY,  NBC_SECONDARY, NBC_SPARE0,  NBC_SPARE1,
                              NBC_TEXTURE0, NBC_TEXTURE1, NBC_TEXTURE2,  NBC_TEXTURE3}; /* of the registers in `in` */
  nbc_words chip;
  nbc_state state;
  int i;
  for (i = 0; i < 8; ++i) {
    const uint32_t *const word = words + STAGES + EACH * i;
    chip.in_rgb[i] = word[IN_RGB];
    chip.out_rgb[i] = word[OUT_RGB];
    chip.in_alpha[i] = word[IN_ALPHA];
    chip.out_alpha[i] = word[OUT_ALPHA];
    chip.stage_color0[i] = word[STAGE_COLOR0];
    chip.stage_color1[i] = word[STAGE_COLOR1];
  }
  chip.color[0] = words[COLOR0];
  chip.color[1] = words[COLOR1];
  chip.final0 = words[FINAL0];
  chip.final1 = words[FINAL1];
  chip.enable = words[ENABLE];
  for (i = 0; i < 36; ++i) registers[order[i / 4]][i % 4] = in[i];
  return nbc_read_words(&chip, NBC_NV20, &state) && nbc_compile(&state, nbc_find_profile("nv2a"), program);
}

void combine(const uint32_t words[], const int16_t in[], uint8_t out[4]);
void combine(const uint32_t words[], const int16_t in[], uint8_t out[4]) {
  int16_t registers[NBC_REGISTERS][4] = {{0}}, color[4];
  nbc_program program;
  int i;
  for (i = 0; i < 4; ++i) out[i] = 0;
  if (!start(words, in, &program, registers)) return;
  nbc_evaluate(&program, registers, color);
  for (i = 0; i < 4; ++i) out[i] = nbc_byte(&program.datapath, color[i]);
}
