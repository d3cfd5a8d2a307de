#include <gtest/gtest.h>
#include <ninebit/combiner/initial_registers.h>
#include <ninebit/numerics/hardware_profile.h>

TEST(Examples, InitialRegisters) {
  using namespace ninebit;
  FragmentInputs in;
  in.primary = {255, 128, 0, 255};
  in.texture[0] = Texel{.value = {200}, .format = TextureFormat::luminance};
  const RegisterFile registers = initial_registers(profiles::geforce2, in);
  EXPECT_EQ(registers[Register::texture0], (Rgba9{200, 200, 200, 255}));
  EXPECT_EQ(registers[Register::spare0], (Rgba9{0, 0, 0, 255}));  // its alpha is texture 0's
}
