// The example of docs/library.md, to the letter.
#include <ninebit/combiner/initial_registers.h>
#include <ninebit/language/gl_nv.h>

#include <cstdio>

int main() {
  using namespace ninebit::gl;
  Context context;  // a GeForce 2 with OpenGL's defaults
  const CurrentContext current(context);
  // spare0 = 2 · primary · texture 0; the default final combiner then passes it through the colour sum and fog.
  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_SCALE_BY_TWO_NV, GL_NONE,
                     GL_FALSE, GL_FALSE, GL_FALSE);

  const auto program = ninebit::compile(context.state(), context.profile());
  if (!program) return std::fprintf(stderr, "%s\n", program.error().text().c_str()), 1;

  ninebit::FragmentInputs in;
  in.primary = {201, 99, 51, 255};
  in.texture[0] = ninebit::Texel{.value = {128, 128, 128, 255}};
  const ninebit::Rgba9 out = ninebit::evaluate(*program, ninebit::initial_registers(context.profile(), in));
  std::printf("%d %d %d %d\n", out[0], out[1], out[2], out[3]);
}
