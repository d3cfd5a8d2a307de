// One program on one fragment, as docs/evaluate.md shows it.
#include <ninebit/combiner/evaluate.h>
#include <ninebit/combiner/initial_registers.h>
#include <ninebit/language/rc10.h>

#include <cstdio>

int main() {
  const char* text = "!!RC1.0\n{ rgb { spare0 = col0 * tex0; scale_by_two(); } }\nout.rgb = spare0; out.a = tex0.a;\n";
  const ninebit::HardwareProfile& chip = ninebit::profiles::geforce2;
  const auto state = ninebit::parse_rc10({text, "double.rc1"}, chip);
  if (!state) return std::fprintf(stderr, "%s\n", state.faults()[0].text().c_str()), 1;
  const auto program = ninebit::compile(*state, chip);
  if (!program) return std::fprintf(stderr, "%s\n", program.error().text().c_str()), 1;

  ninebit::FragmentInputs in;
  in.primary = {201, 99, 51, 255};
  in.texture[0] = ninebit::Texel{.value = {128, 128, 128, 255}};
  const ninebit::Rgba9 out = ninebit::evaluate(*program, ninebit::initial_registers(chip, in));
  std::printf("%d %d %d %d\n", out[0], out[1], out[2], out[3]);
}
