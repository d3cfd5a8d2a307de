/* One program on one fragment, as docs/evaluate.md shows it. */
#include <ninebit/capi/combiner.h>
#include <stdio.h>
#include <string.h>

int main(void) {
  const char *text = "!!RC1.0\n{ rgb { spare0 = col0 * tex0; scale_by_two(); } }\nout.rgb = spare0; out.a = tex0.a;\n";
  ninebit_state *state = NULL;
  ninebit_program *program = NULL;
  ninebit_inputs in = {.struct_size = sizeof in, .primary = {201, 99, 51, 255}};
  ninebit_registers registers = {.struct_size = sizeof registers};
  int16_t out[4];
  char *error = NULL;
  in.texture_enabled[0] = 1;
  memset(in.texture[0], 128, 3);
  in.texture[0][3] = 255;
  if (ninebit_state_parse("geforce2", NINEBIT_FORM_RC10, text, strlen(text), &state, &error) != NINEBIT_OK ||
      ninebit_compile(state, &program, &error) != NINEBIT_OK ||
      ninebit_initial_registers(program, &in, &registers, &error) != NINEBIT_OK ||
      ninebit_evaluate(program, &registers, out, NULL, &error) != NINEBIT_OK) {
    fprintf(stderr, "%s\n", error != NULL ? error : "out of memory");
    ninebit_free_text(error);
  } else {
    printf("%d %d %d %d\n", out[0], out[1], out[2], out[3]);
  }
  ninebit_program_free(program);
  ninebit_state_free(state);
  return error != NULL;
}
