#include "src/frame/drawn_passes.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "ninebit/combiner/batch_program.h"

namespace ninebit {

namespace {

bool changes_stencil(const StencilFace& face) {
  constexpr StencilOperation kKeep = StencilOperation::keep;
  return face.fail != kKeep || face.depth_fail != kKeep || face.depth_pass != kKeep;
}

bool marks_shadows(const StencilTest& test) {
  return test.enabled && (changes_stencil(test.front) || (test.back && changes_stencil(*test.back)));
}

void note(Rendering& rendering, DrawnPass pass) {
  const auto known = [&](const DrawnPass& other) { return other.name == pass.name; };
  if (std::any_of(rendering.drawn.begin(), rendering.drawn.end(), known)) return;
  rendering.drawn.push_back(std::move(pass));
}

std::uint64_t texel_size(InternalFormat format) {
  switch (format) {
    case InternalFormat::alpha8:
    case InternalFormat::luminance8:
    case InternalFormat::intensity8:
      return 1;
    case InternalFormat::luminance8_alpha8:
    case InternalFormat::depth16:
    case InternalFormat::dsdt8:
      return 2;
    case InternalFormat::rgb8:
    case InternalFormat::rgba8:
    case InternalFormat::depth24:
    case InternalFormat::hilo16:
    case InternalFormat::dsdt8_mag8:
    case InternalFormat::dsdt8_mag8_intensity8:
      return 4;
    case InternalFormat::rgba16f:
      return 8;
    case InternalFormat::rgba32f:
      return 16;
  }
  return 0;
}

}  // namespace

void note_pass(Rendering& rendering, std::string_view name, const PipelineState& state) {
  const int units = state.program ? texture_units_read(*state.program) : 0;
  note(rendering, {std::string(name), marks_shadows(state.stencil_test), units});
}

void note_float_pass(Rendering& rendering, std::string_view name, bool marks_shadows) {
  note(rendering, {std::string(name), marks_shadows, std::nullopt});
}

std::uint64_t texture_bytes(const Texture& texture) {
  std::uint64_t texels = 0;
  for (std::size_t f = 0; f < texture.face_count(); ++f) {
    for (const TextureImage& level : texture.faces[f]) {
      texels += static_cast<std::uint64_t>(level.width) * static_cast<std::uint64_t>(level.height);
    }
  }
  return texels * texel_size(texture.format);
}

int texture_units_read(const Program& program) {
  constexpr std::array kRegisters{Register::texture0, Register::texture1, Register::texture2, Register::texture3};
  const ComponentSet reads = BatchProgram(program).reads();
  int count = 0;
  for (const Register reg : kRegisters) {
    bool read = false;
    for (int c = 0; c < 4; ++c) read = read || reads.contains(reg, c);
    count += read ? 1 : 0;
  }
  return count;
}

}  // namespace ninebit
