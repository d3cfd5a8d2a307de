// The registers' values from texels, colours and fog.
#include "ninebit/combiner/initial_registers.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "combiner_tests/combiner/support.h"
#include "combiner_tests/hardware/csv.h"

namespace ninebit::test {
namespace {

TEST(InitialRegisters, InputsEnterAndTheRestIsAsTheProfileSays) {
  FragmentInputs inputs;
  inputs.primary = {1, 2, 3, 4};
  inputs.secondary = {5, 6, 7, 8};
  inputs.fog_color = {9, 10, 11};
  inputs.fog_factor = std::uint8_t{12};
  inputs.texture[0] = Texel{.value = {13, 14, 15, 16}};
  inputs.texture[1] = Texel{.value = {17, 18, 19, 20}};
  const RegisterFile card = initial_registers(profiles::geforce2, inputs);
  EXPECT_EQ(card[Register::zero], codes(0, 0, 0, 0));
  EXPECT_EQ(card[Register::primary], codes(1, 2, 3, 4));
  EXPECT_EQ(card[Register::secondary], codes(5, 6, 7, 255)) << "NV1x: secondary alpha is 1.0";
  EXPECT_EQ(card[Register::fog], codes(9, 10, 11, 12));
  EXPECT_EQ(card[Register::texture0], codes(13, 14, 15, 16));
  EXPECT_EQ(card[Register::texture1], codes(17, 18, 19, 20));
  EXPECT_EQ(card[Register::spare0], codes(0, 0, 0, 16)) << "texture 0's alpha";
  EXPECT_EQ(card[Register::spare1], codes(0, 0, 0, 0));
  const RegisterFile xbox = initial_registers(profiles::nv2a, inputs);
  EXPECT_EQ(xbox[Register::secondary], codes(5, 6, 7, 8));
  EXPECT_EQ(xbox[Register::texture2], codes(0, 0, 0, 255));
  EXPECT_EQ(xbox[Register::texture3], codes(0, 0, 0, 255));
  const RegisterFile eight = initial_registers(profiles::geforce256_8bit, inputs);
  EXPECT_EQ(eight[Register::primary], codes(0, 1, 1, 2));
  EXPECT_EQ(eight[Register::secondary], codes(2, 3, 3, 127));
  EXPECT_EQ(eight[Register::fog], codes(4, 5, 5, 6));
  EXPECT_EQ(eight[Register::spare0], codes(0, 0, 0, 8));
}

TEST(InitialRegisters, UnitsThatAreOff) {
  FragmentInputs inputs;
  inputs.texture[1] = Texel{.value = {21, 22, 23, 24}};
  const RegisterFile r = initial_registers(profiles::geforce2, inputs);
  EXPECT_EQ(r[Register::texture0], codes(0, 0, 0, 255));
  EXPECT_EQ(r[Register::texture1], codes(21, 22, 23, 24)) << "units are absolute";
  EXPECT_EQ(r[Register::spare0], codes(0, 0, 0, 255));
  EXPECT_EQ(initial_registers(profiles::geforce256_8bit, {})[Register::spare0], codes(0, 0, 0, 127));
}

TEST(InitialRegisters, ProfileFieldsDecide) {
  HardwareProfile p = profiles::geforce2;
  p.spare0_alpha_without_texture0.value = 9;
  p.disabled_texture_alpha.value = 7;
  p.fog_alpha_without_fog.value = 5;
  p.secondary_alpha.value = SecondaryAlpha::as_given;
  FragmentInputs inputs;
  inputs.secondary = {0, 0, 0, 33};
  inputs.fog_color = {1, 2, 3};
  const RegisterFile r = initial_registers(p, inputs);
  EXPECT_EQ(r[Register::spare0][kAlpha], 9);
  EXPECT_EQ(r[Register::texture0], codes(0, 0, 0, 7));
  EXPECT_EQ(r[Register::fog], codes(1, 2, 3, 5)) << "the fog colour is there without fog, the factor is not";
  EXPECT_EQ(r[Register::secondary][kAlpha], 33);
}

// GL's default final combiner is colour sum and fog: f (spare0 + secondary) + (1 - f) fog colour.
TEST(InitialRegisters, DefaultProgramDrawsSecondaryColorAndFog) {
  FragmentInputs inputs;
  inputs.primary = {100, 60, 20, 77};
  inputs.secondary = {50, 200, 0, 0};
  inputs.fog_color = {255, 0, 10};
  const auto color = [&](std::optional<std::uint8_t> factor) {
    inputs.fog_factor = factor;
    return judged({}, profiles::geforce2, initial_registers(profiles::geforce2, inputs)).color;
  };
  EXPECT_EQ(color(std::nullopt), codes(150, 255, 20, 77)) << "without fog: the clamped sum";
  EXPECT_EQ(color(std::uint8_t{255}), codes(150, 255, 20, 77));
  EXPECT_EQ(color(std::uint8_t{0}), codes(255, 0, 10, 77));
  EXPECT_EQ(color(std::uint8_t{51}), codes(234, 51, 12, 77)) << "a fifth of the sum, four fifths of the fog";
}

// The table of NV_register_combiners, whose rows differ from the texture environment's.
TEST(Texels, EveryFormatEntersByTheExtensionsTable) {
  struct Row {
    TextureFormat format;
    Rgba9 expected;
  };
  const std::vector<Row> rows{{TextureFormat::alpha, codes(0, 0, 0, 40)},
                              {TextureFormat::luminance, codes(10, 10, 10, 255)},
                              {TextureFormat::luminance_alpha, codes(10, 10, 10, 40)},
                              {TextureFormat::intensity, codes(10, 10, 10, 10)},
                              {TextureFormat::rgb, codes(10, 20, 30, 255)},
                              {TextureFormat::rgba, codes(10, 20, 30, 40)},
                              {TextureFormat::depth, codes(0, 0, 0, 10)},
                              {TextureFormat::depth_comparison, codes(10, 10, 10, 10)},
                              {TextureFormat::hilo, codes(0, 0, 0, 0)},
                              {TextureFormat::dsdt, codes(0, 0, 0, 0)},
                              {TextureFormat::dsdt_mag, codes(0, 0, 0, 0)},
                              {TextureFormat::dsdt_mag_intensity, codes(0, 0, 0, 40)}};
  for (const Row& row : rows) {
    const Texel texel{.value = {10, 20, 30, 40}, .format = row.format};
    EXPECT_EQ(texel_codes(profiles::geforce2, texel), row.expected) << static_cast<int>(row.format);
    FragmentInputs inputs;
    inputs.texture[0] = texel;
    const RegisterFile r = initial_registers(profiles::geforce2, inputs);
    EXPECT_EQ(r[Register::texture0], row.expected);
    EXPECT_EQ(r[Register::spare0], codes(0, 0, 0, row.expected[kAlpha])) << "spare0 alpha is the register's";
  }
  const Texel luminance{.value = {201, 0, 0, 0}, .format = TextureFormat::luminance};
  EXPECT_EQ(texel_codes(profiles::geforce256_8bit, luminance), codes(100, 100, 100, 127)) << "1.0 is the profile's";
}

// Rule 15, all 256 bytes: pictures of an NV2A. The final combiner that drew them shows no negative part.
TEST(HardwareRows, SignedTexels) {
  int rows = 0;
  for (const auto& row : read_hardware_table("nv2a_signed_texel")) {
    const auto byte = static_cast<std::uint8_t>(std::stoi(row.at("texel_byte")));
    FragmentInputs inputs;
    inputs.texture[0] = Texel{.value = {byte, byte, byte, byte}, .is_signed = true};
    const RegisterFile registers = initial_registers(profiles::nv2a, inputs);
    CombinerState state = silent_state(1);
    state.final_combiner.d = rgb_of(Register::texture0);
    const Rgba9 color = judged(state, profiles::nv2a, registers).color;
    EXPECT_EQ(color[0], std::stoi(row.at("hw_R"))) << int{byte};
    EXPECT_EQ(color[1], std::stoi(row.at("hw_G"))) << int{byte};
    EXPECT_EQ(color[2], std::stoi(row.at("hw_B"))) << int{byte};
    const int s = std::stoi(row.at("as_int8"));
    EXPECT_EQ(registers[Register::texture0][0], 2 * s) << "the sign is kept in the register";
    ++rows;
  }
  EXPECT_EQ(rows, 256);
}

TEST(Texels, SignedBytesOfOtherProfiles) {
  EXPECT_EQ(texel_codes(profiles::nv2a, {.value = {128, 127, 255, 0}, .is_signed = true}), codes(-256, 254, -2, 0));
  EXPECT_EQ(texel_codes(profiles::geforce2, {.value = {128, 127, 255, 0}, .is_signed = true}), codes(-255, 254, -2, 0));
  EXPECT_EQ(texel_codes(profiles::geforce256_8bit, {.value = {128, 127, 255, 0}, .is_signed = true}),
            codes(-127, 127, -1, 0));
}

}  // namespace
}  // namespace ninebit::test
