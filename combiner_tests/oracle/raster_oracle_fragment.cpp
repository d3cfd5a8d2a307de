#include "combiner_tests/oracle/raster_oracle_fragment.h"

#include <cstdlib>

namespace ninebit::oracle {
namespace {

bool passes(CompareFunction function, std::int64_t left, std::int64_t right) {
  switch (function) {
    case CompareFunction::never:
      return false;
    case CompareFunction::less:
      return left < right;
    case CompareFunction::equal:
      return left == right;
    case CompareFunction::lequal:
      return left <= right;
    case CompareFunction::greater:
      return left > right;
    case CompareFunction::notequal:
      return left != right;
    case CompareFunction::gequal:
      return left >= right;
    case CompareFunction::always:
      return true;
  }
  return false;
}

// s of the specification.
int bits_of(DepthStencilFormat format) {
  switch (format) {
    case DepthStencilFormat::d24s8:
    case DepthStencilFormat::f24s8:
    case DepthStencilFormat::w24s8:
    case DepthStencilFormat::wf24s8:
      return 8;
    case DepthStencilFormat::d15s1:
      return 1;
    default:
      return 0;
  }
}

int reference_of(const StencilFace& face, int largest) {
  if (face.reference < 0) return 0;
  return face.reference > largest ? largest : face.reference;
}

// A factor of component i, in 255ths.
int factor(BlendFactor name, const Bytes& source, const Bytes& destination, const Bytes& constant, std::size_t i) {
  switch (name) {
    case BlendFactor::zero:
      return 0;
    case BlendFactor::one:
      return 255;
    case BlendFactor::src_color:
      return source[i];
    case BlendFactor::one_minus_src_color:
      return 255 - source[i];
    case BlendFactor::dst_color:
      return destination[i];
    case BlendFactor::one_minus_dst_color:
      return 255 - destination[i];
    case BlendFactor::src_alpha:
      return source[3];
    case BlendFactor::one_minus_src_alpha:
      return 255 - source[3];
    case BlendFactor::dst_alpha:
      return destination[3];
    case BlendFactor::one_minus_dst_alpha:
      return 255 - destination[3];
    case BlendFactor::constant_color:
      return constant[i];
    case BlendFactor::one_minus_constant_color:
      return 255 - constant[i];
    case BlendFactor::constant_alpha:
      return constant[3];
    case BlendFactor::one_minus_constant_alpha:
      return 255 - constant[3];
    case BlendFactor::src_alpha_saturate:
      if (i == 3) return 255;
      return source[3] < 255 - destination[3] ? source[3] : 255 - destination[3];
  }
  return 0;
}

// The byte that lies nearest to wide / 255, searched for.
std::uint8_t nearest_byte(int wide) {
  constexpr int kLowest = -255 * 255, kHighest = 2 * 255 * 255;
  static const std::vector<std::uint8_t> found = [] {
    std::vector<std::uint8_t> bytes;
    for (int n = kLowest; n <= kHighest; ++n) {
      int best = 0;
      for (int byte = 1; byte <= 255; ++byte) {
        if (std::abs(255 * byte - n) < std::abs(255 * best - n)) best = byte;
      }
      bytes.push_back(static_cast<std::uint8_t>(best));
    }
    return bytes;
  }();
  return found.at(static_cast<std::size_t>(wide - kLowest));
}

// The bits of red, green, blue and alpha in a surface's words.
std::array<int, 4> widths(ColorFormat format) {
  switch (format) {
    case ColorFormat::a8r8g8b8:
      return {8, 8, 8, 8};
    case ColorFormat::x8r8g8b8_z:
    case ColorFormat::x8r8g8b8_o:
      return {8, 8, 8, 0};
    case ColorFormat::x1a7r8g8b8_z:
    case ColorFormat::x1a7r8g8b8_o:
      return {8, 8, 8, 7};
    case ColorFormat::r5g6b5:
      return {5, 6, 5, 0};
    case ColorFormat::x1r5g5b5_z:
    case ColorFormat::x1r5g5b5_o:
      return {5, 5, 5, 0};
    case ColorFormat::g8b8:
      return {0, 8, 8, 0};
    case ColorFormat::b8:
      return {0, 0, 8, 0};
  }
  return {8, 8, 8, 8};
}

// The source's colour is cut first; its alpha is not. Stored colours have zeros below their bits; seven bits of alpha
// are repeated; an alpha that is not there is 255.
Bytes blended_in(const PipelineState& state, ColorFormat format, Bytes source, Bytes there) {
  const std::array<int, 4> bits = widths(format);
  for (std::size_t i = 0; i < 3 && state.profile.surface_blend.value == SurfaceBlend::zeros; ++i) {
    const int step = 1 << (8 - bits[i]);
    source[i] = static_cast<std::uint8_t>(source[i] / step * step);
    there[i] = static_cast<std::uint8_t>(there[i] / step * step);
  }
  if (bits[3] == 7) there[3] = static_cast<std::uint8_t>(there[3] / 2 * 2 + there[3] / 128);
  if (bits[3] == 0) there[3] = 255;
  return blended(state.blend, source, there);
}

// So many of eight samples as an alpha: 31, 63, 95, …, 255.
int coverage_alpha(int samples) {
  return samples == 0 ? 0 : 32 * samples - 1;
}

}  // namespace

Bytes kept(ColorFormat format, const Bytes& color) {
  const std::array<int, 4> bits = widths(format);
  Bytes result{};
  for (std::size_t i = 0; i < 4; ++i) {
    if (bits[i] == 0) {
      result[i] = i == 3 ? 255 : 0;
      continue;
    }
    const int code = color[i] / (1 << (8 - bits[i]));
    const int wide = code * (1 << (8 - bits[i]));
    result[i] = static_cast<std::uint8_t>(bits[i] == 8 ? wide : wide + code / (1 << (2 * bits[i] - 8)));
  }
  return result;
}

int after_stencil(const StencilFace& face, StencilOperation operation, int bits, int memory) {
  const int values = 1 << bits, stored = memory % values;
  int result = stored;
  if (operation == StencilOperation::zero) result = 0;
  if (operation == StencilOperation::replace) result = reference_of(face, values - 1);
  if (operation == StencilOperation::incr && stored < values - 1) result = stored + 1;
  if (operation == StencilOperation::decr && stored > 0) result = stored - 1;
  if (operation == StencilOperation::invert) result = values - 1 - stored;
  if (operation == StencilOperation::incr_wrap) result = (stored + 1) % values;
  if (operation == StencilOperation::decr_wrap) result = (stored + values - 1) % values;
  int merged = memory - stored;  // what lies beyond the s bits is not the stencil buffer's
  for (int bit = 1; bit < values; bit *= 2) {
    const int from = (face.write_mask & bit) != 0 ? result : stored;
    if ((from & bit) != 0) merged += bit;
  }
  return merged;
}

Bytes blended(const Blend& blend, const Bytes& source, const Bytes& destination) {
  Bytes result{};
  for (std::size_t i = 0; i < 4; ++i) {
    const int s = source[i] * factor(blend.source, source, destination, blend.color, i);
    const int d = destination[i] * factor(blend.destination, source, destination, blend.color, i);
    switch (blend.equation) {
      case BlendEquation::add:
        result[i] = nearest_byte(s + d);
        break;
      case BlendEquation::subtract:
        result[i] = nearest_byte(s - d);
        break;
      case BlendEquation::reverse_subtract:
        result[i] = nearest_byte(d - s);
        break;
      case BlendEquation::min:
        result[i] = source[i] < destination[i] ? source[i] : destination[i];
        break;
      case BlendEquation::max:
        result[i] = source[i] > destination[i] ? source[i] : destination[i];
        break;
      case BlendEquation::add_signed:
      case BlendEquation::reverse_subtract_signed: {
        int value = source[i] >= 128 ? source[i] - 256 : source[i];
        if (blend.equation == BlendEquation::reverse_subtract_signed) value = -value;
        value += destination[i];
        result[i] = static_cast<std::uint8_t>(value < 0 ? 0 : value > 255 ? 255 : value);
        break;
      }
    }
  }
  return result;
}

void process(const PipelineState& state, const Incoming& given, Picture& picture, Tally& tally) {
  Incoming f = given;
  if (state.scissor) {
    const PixelRect& s = *state.scissor;
    if (f.x < s.x || f.y < s.y) return;
    if (std::int64_t{f.x} >= std::int64_t{s.x} + s.width || std::int64_t{f.y} >= std::int64_t{s.y} + s.height) return;
  }
  ++tally.fragments;
  const auto at =
      static_cast<std::size_t>(f.y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(f.x);
  const bool depth_passes =
      !state.depth_test.enabled || passes(state.depth_test.function, f.depth, std::int64_t{picture.depth[at]});
  if (depth_passes) picture.captured[at] = f.color[0];

  if (f.coverage != 8) {
    const int product = f.color[3] * coverage_alpha(f.coverage);
    const bool cut = state.profile.coverage_narrowing.value == Narrowing::toward_zero;
    f.color[3] = cut ? static_cast<std::uint8_t>(product / 255) : nearest_byte(product);
  }
  if (state.alpha_test.enabled && !passes(state.alpha_test.function, f.color[3], state.alpha_test.reference)) {
    ++tally.alpha_fail;
    return;
  }
  const int bits = bits_of(picture.format);
  if (state.stencil_test.enabled && bits > 0) {
    const StencilTest& test = state.stencil_test;
    const StencilFace& face = !f.front_facing && test.back ? *test.back : test.front;
    const int values = 1 << bits;
    std::uint8_t& memory = picture.stencil[at];
    if (!passes(face.function, reference_of(face, values - 1) & face.mask, memory % values & face.mask)) {
      ++tally.stencil_fail;
      memory = static_cast<std::uint8_t>(after_stencil(face, face.fail, bits, memory));
      return;
    }
    const StencilOperation operation = depth_passes ? face.depth_pass : face.depth_fail;
    memory = static_cast<std::uint8_t>(after_stencil(face, operation, bits, memory));
  }
  if (!depth_passes) {
    ++tally.depth_fail;
    return;
  }
  ++tally.drawn;
  if (state.depth_test.enabled && state.depth_test.write) picture.depth[at] = static_cast<std::uint32_t>(f.depth);
  Bytes there = picture.color[at];
  if (!picture.has_alpha) there[3] = 255;
  const Bytes whole = state.blend.enabled ? blended_in(state, picture.color_format, f.color, there) : f.color;
  const Bytes color = kept(picture.color_format, whole);
  for (std::size_t i = 0; i < 4; ++i) {
    if ((i < 3 || picture.has_alpha) && state.color_mask[i]) picture.color[at][i] = color[i];
  }
  picture.primitive[at] = f.number;
}

}  // namespace ninebit::oracle
