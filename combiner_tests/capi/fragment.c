/* The C interface, step by step: a program as text, what is wrong with a worse one, one fragment, many fragments, a trace,
   GLSL. C99; link with ninebit_capi. */
#include <ninebit/capi/combiner.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check(ninebit_result result, char *error) {
  if (result == NINEBIT_OK) return;
  fprintf(stderr, "%s\n", error != NULL ? error : "out of memory");
  ninebit_free_text(error);
  exit(EXIT_FAILURE);
}

int main(void) {
  /* spare0 = 2 · primary · texture 0, drawn as it is. */
  const char *const text =
      "!!RC1.0\n"
      "{\n"
      "  rgb { spare0 = col0 * tex0; scale_by_two(); }\n"
      "}\n"
      "out.rgb = spare0;\n"
      "out.a = unsigned_invert(zero);\n";
  char *error = NULL;
  ninebit_state *state = NULL;
  check(ninebit_state_parse("geforce2", NINEBIT_FORM_RC10, text, strlen(text), &state, &error), error);

  /* What is wrong with a text comes with its place. */
  ninebit_state *none = NULL;
  if (ninebit_state_parse("geforce2", NINEBIT_FORM_RC10, "!!RC1.0\nout.rgb = spare2;", 25, &none, &error) == NINEBIT_OK) {
    return EXIT_FAILURE;
  }
  printf("refused: %s\n", error);
  ninebit_free_text(error);

  ninebit_program *program = NULL;
  check(ninebit_compile(state, &program, &error), error);
  ninebit_state_free(state); /* the program does not need it */

  /* One fragment. */
  ninebit_inputs inputs;
  memset(&inputs, 0, sizeof inputs);
  inputs.struct_size = sizeof inputs;
  memcpy(inputs.primary, (const uint8_t[4]){201, 99, 51, 255}, 4);
  inputs.texture_enabled[0] = 1;
  memcpy(inputs.texture[0], (const uint8_t[4]){128, 128, 128, 255}, 4);
  ninebit_registers registers;
  registers.struct_size = sizeof registers;
  check(ninebit_initial_registers(program, &inputs, &registers, &error), error);
  int16_t color[4];
  check(ninebit_evaluate(program, &registers, color, NULL, &error), error);
  printf("one fragment: %d %d %d %d\n", color[0], color[1], color[2], color[3]);

  /* A thousand: primary red from 0 to 255 again and again, texture 0 always 128. */
  enum { COUNT = 1000 };
  static int16_t primary[COUNT], texel[COUNT], red[COUNT];
  for (int i = 0; i < COUNT; ++i) {
    primary[i] = (int16_t)(i % 256);
    texel[i] = 128;
  }
  ninebit_planes planes;
  memset(&planes, 0, sizeof planes);
  planes.struct_size = sizeof planes;
  planes.count = COUNT;
  planes.input[NINEBIT_PRIMARY][0] = primary;
  planes.input[NINEBIT_TEXTURE0][0] = texel;
  planes.color[0] = red;
  check(ninebit_evaluate_planes(program, &planes, &error), error);
  printf("red of fragment 201: %d\n", red[201]);

  char *json = NULL, *glsl = NULL;
  check(ninebit_trace_json(program, &registers, &json, &error), error);
  printf("the trace tells of codes: %s\n", strstr(json, "\"codes\"") != NULL ? "yes" : "no");
  check(ninebit_emit_glsl(program, 330, "combine", &glsl, &error), error);
  printf("GLSL begins with %.12s\n", glsl);
  ninebit_free_text(json);
  ninebit_free_text(glsl);
  ninebit_program_free(program);
  return EXIT_SUCCESS;
}
