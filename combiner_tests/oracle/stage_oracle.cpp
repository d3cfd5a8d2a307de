#include "combiner_tests/oracle/stage_oracle.h"

#include <cmath>
#include <string>

namespace ninebit::oracle {
namespace {

using Op = TextureOperation;
using Four = std::array<int, 4>;

int complement(int value, int range) {
  return value >= range / 2 ? value - range : value;
}

// The operations by what they are, without the library's table.
bool is_offset(Op op) {
  return op == Op::offset_2d || op == Op::offset_2d_scale || op == Op::offset_rectangle ||
         op == Op::offset_rectangle_scale;
}
bool is_scaled(Op op) {
  return op == Op::offset_2d_scale || op == Op::offset_rectangle_scale;
}
bool is_dependent(Op op) {
  return op == Op::dependent_ar || op == Op::dependent_gb;
}
bool is_reflect(Op op) {
  return op == Op::dot_product_reflect_cube_map || op == Op::dot_product_const_eye_reflect_cube_map;
}
bool is_dot(Op op) {
  return op >= Op::dot_product && op <= Op::dot_product_const_eye_reflect_cube_map;
}
bool reads_stage(Op op) {
  return is_offset(op) || is_dependent(op) || is_dot(op);
}
StageTarget target_of(Op op) {
  switch (op) {
    case Op::texture_1d:
      return StageTarget::one_dimensional;
    case Op::texture_2d:
    case Op::offset_2d:
    case Op::offset_2d_scale:
    case Op::dependent_ar:
    case Op::dependent_gb:
    case Op::dot_product_2d:
      return StageTarget::two_dimensional;
    case Op::texture_rectangle:
    case Op::offset_rectangle:
    case Op::offset_rectangle_scale:
    case Op::dot_product_rectangle:
      return StageTarget::rectangle;
    case Op::texture_3d:
    case Op::dot_product_3d:
      return StageTarget::three_dimensional;
    case Op::texture_cube_map:
    case Op::dot_product_cube_map:
    case Op::dot_product_diffuse_cube_map:
    case Op::dot_product_reflect_cube_map:
    case Op::dot_product_const_eye_reflect_cube_map:
      return StageTarget::cube_map;
    default:
      return StageTarget::none;
  }
}

class Stages {
 public:
  explicit Stages(const StageQuestion& question) : q_(question) {}

  StageAnswer run() {
    find_consistency();
    for (int i = 0; i < 4; ++i) {
      if (answer_.consistent[at(i)]) run_stage(i);
    }
    for (int i = 0; i < 4; ++i) find_codes(i);
    return answer_;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  Op op(int i) const { return q_.state.stage[at(i)].operation; }
  const TextureStage& stage(int i) const { return q_.state.stage[at(i)]; }
  bool gl() const { return q_.state.rules == StageRules::open_gl; }

  // Consistency, as a list of what must hold.
  bool signed_any(int i) const {
    const auto& s = q_.textures[at(i)]->is_signed;
    return s[0] || s[1] || s[2] || s[3];
  }
  bool texture_suits(int i) const {
    if (target_of(op(i)) == StageTarget::none) return true;
    const auto& texture = q_.textures[at(i)];
    if (!texture || texture->target != target_of(op(i))) return false;
    if (!gl() || !is_scaled(op(i))) return true;
    return texture->format < TextureFormat::depth && !signed_any(i);
  }
  bool input_suits(int i) const {
    if (!reads_stage(op(i))) return true;
    const int from = stage(i).previous;
    if (!answer_.consistent[at(from)]) return false;
    if (target_of(op(from)) == StageTarget::none && op(from) != Op::pass_through) return false;
    if (!gl()) return true;
    const TextureFormat format = op(from) == Op::pass_through ? TextureFormat::rgba : q_.textures[at(from)]->format;
    const bool is_signed = op(from) != Op::pass_through && signed_any(from);
    const bool mag = format == TextureFormat::dsdt_mag || format == TextureFormat::dsdt_mag_intensity;
    if (is_scaled(op(i))) return mag;
    if (is_offset(op(i))) return mag || format == TextureFormat::dsdt;
    if (is_dependent(op(i))) return format < TextureFormat::depth && !is_signed;
    return format < TextureFormat::depth || format == TextureFormat::hilo;
  }
  bool chain_suits(int i) const {
    const auto is_pad = [&](int n) { return op(n) == Op::dot_product && answer_.consistent[at(n)]; };
    switch (op(i)) {
      case Op::dot_product_2d:
      case Op::dot_product_rectangle:
      case Op::dot_product_depth_replace:
      case Op::dot_product_diffuse_cube_map:
        return is_pad(i - 1);
      case Op::dot_product_3d:
      case Op::dot_product_cube_map:
        return is_pad(1) && is_pad(2);
      case Op::dot_product_reflect_cube_map:
      case Op::dot_product_const_eye_reflect_cube_map:
        return is_pad(1) && (is_pad(2) || (op(2) == Op::dot_product_diffuse_cube_map && answer_.consistent[2]));
      default:
        return true;
    }
  }
  void find_consistency() {
    for (int i = 0; i < 4; ++i) {
      answer_.consistent[at(i)] = texture_suits(i) && input_suits(i) && chain_suits(i);
      // The third dot product of a diffuse cube map comes from the next stage.
      if (i != 2 || op(2) != Op::dot_product_diffuse_cube_map || !answer_.consistent[2]) continue;
      answer_.consistent[2] = is_reflect(op(3)) && stage(3).previous != 2 && input_suits(3);
    }
  }

  int byte_of(float c) const {
    if (std::isnan(c)) return 0;
    if (q_.profile.negative_stage_number.value == NegativeNumber::size && c < 0) c = -c;
    if (q_.profile.stage_byte.value == StageByte::nearest) {
      if (c <= 0) return 0;
      return c >= 1 ? 255 : static_cast<int>(c * 255.0F + 0.5F);
    }
    const double n = std::floor(4096.0 * static_cast<double>(c));
    const int clamped = n < 0 ? 0 : n > 4095 ? 4095 : static_cast<int>(n);
    return 255 * (clamped + 1) / 4096;
  }

  DotMapping mapping_of(int i) const {
    const int from = stage(i).previous;
    if (!gl() || target_of(op(from)) == StageTarget::none || !q_.textures[at(from)]) return stage(i).mapping;
    const bool hilo = q_.textures[at(from)]->format == TextureFormat::hilo;
    if (hilo) return signed_any(from) ? DotMapping::hilo_hemisphere : DotMapping::hilo_1;
    if (q_.textures[at(from)]->format >= TextureFormat::depth) return stage(i).mapping;
    return signed_any(from) ? DotMapping::minus1_to_1 : stage(i).mapping;
  }

  float dot_of(int i, DotMapping mapping) {
    const Four& t = answer_.texel[at(stage(i).previous)];
    const auto& c = q_.coordinate[at(i)];
    const bool odd = q_.profile.dot_divisors.value == DotDivisors::odd;
    const auto over = [&](float x, float y, float z, float divisor) {
      const float first = c[0] * x, second = c[1] * y, third = c[2] * z;
      const float two = first + second;
      const float sum = two + third;
      return sum / divisor;
    };
    const auto real = [](int n) { return static_cast<float>(n); };
    const int high = 256 * t[3] + t[0], low = 256 * t[1] + t[2];
    switch (mapping) {
      case DotMapping::minus1_to_1_d3d:
        return over(real(t[0] - 128), real(t[1] - 128), real(t[2] - 128), odd ? 127.0F : 128.0F);
      case DotMapping::minus1_to_1_gl:
        return over(real(2 * complement(t[0], 256) + 1), real(2 * complement(t[1], 256) + 1),
                    real(2 * complement(t[2], 256) + 1), odd ? 255.0F : 256.0F);
      case DotMapping::minus1_to_1:
        return over(real(complement(t[0], 256)), real(complement(t[1], 256)), real(complement(t[2], 256)),
                    odd ? 127.0F : 128.0F);
      case DotMapping::hilo_1:
        return over(real(high) / 65535.0F, real(low) / 65535.0F, 1.0F, 1.0F);
      case DotMapping::hilo_hemisphere: {
        const long h = complement(high, 65536), l = complement(low, 65536);
        const long left = 1073741824L - h * h - l * l;
        long root = 0;
        while (left > 0 && (root + 4096) * (root + 4096) <= left) root += 4096;
        while (left > 0 && (root + 64) * (root + 64) <= left) root += 64;
        while (left > 0 && (root + 1) * (root + 1) <= left) ++root;
        return over(static_cast<float>(h) / 32767.0F, static_cast<float>(l) / 32767.0F,
                    static_cast<float>(root) / 32768.0F, 1.0F);
      }
      default:
        return over(real(t[0]), real(t[1]), real(t[2]), 255.0F);
    }
  }

  void fetch(int i, float s, float t, float r) {
    answer_.texel[at(i)] = q_.fetch(i, {s, t, r}), fetched_[at(i)] = true;
  }

  void run_stage(int i) {
    const auto& c = q_.coordinate[at(i)];
    Four& texel = answer_.texel[at(i)];
    const Four from = answer_.texel[at(stage(i).previous)];
    if (is_dot(op(i))) answer_.dot[at(i)] = dot_of(i, mapping_of(i));
    if (is_offset(op(i))) {
      const float ds = static_cast<float>(complement(from[2], 256)) / 128.0F;
      const float dt = static_cast<float>(complement(from[1], 256)) / 128.0F;
      const auto& m = stage(i).matrix;
      const float u = c[0] + m[0] * ds, v = c[1] + m[1] * ds;
      fetch(i, u + m[2] * dt, v + m[3] * dt, 0.0F);
      if (!is_scaled(op(i))) return;
      const float scaled = stage(i).scale * (static_cast<float>(from[0]) / 255.0F);
      const float factor = scaled + stage(i).bias;
      for (std::size_t k = 0; k < 3; ++k) texel[k] = byte_of(static_cast<float>(texel[k]) / 255.0F * factor);
      return;
    }
    if (is_dependent(op(i))) {
      const auto divisor = static_cast<float>(q_.profile.dependent_divisor.value);
      const bool ar = op(i) == Op::dependent_ar;
      return fetch(i, static_cast<float>(ar ? from[3] : from[1]) / divisor,
                   static_cast<float>(ar ? from[0] : from[2]) / divisor, 0.0F);
    }
    switch (op(i)) {
      case Op::none:
        texel = {0, 0, 0, q_.state.rules == StageRules::nv2a ? q_.profile.disabled_texture_alpha : 0};
        return;
      case Op::texture_1d:
      case Op::texture_2d:
      case Op::texture_rectangle:
      case Op::texture_3d:
        return fetch(i, c[0] / c[3], c[1] / c[3], c[2] / c[3]);
      case Op::texture_cube_map:
        return fetch(i, c[0], c[1], c[2]);
      case Op::pass_through:
        for (std::size_t k = 0; k < 4; ++k) texel[k] = byte_of(c[k]);
        return;
      case Op::cull_fragment:
        for (std::size_t k = 0; k < 4; ++k) {
          const bool negative_dies = stage(i).cull[k] == CullMode::kills_negative;
          const bool by_sign = q_.profile.cull_zero.value == CullZero::by_sign;
          const bool negative = by_sign && c[k] == 0 ? std::signbit(c[k]) : c[k] < 0;
          if (!std::isnan(c[k]) && negative == negative_dies) answer_.culled = true;
        }
        return;
      default:
        return finish_dots(i);
    }
  }

  void finish_dots(int i) {
    const auto dot = [&](int n) { return *answer_.dot[at(n)]; };
    switch (op(i)) {
      case Op::dot_product_2d:
      case Op::dot_product_rectangle:
        return fetch(i, dot(i - 1), dot(i), 0.0F);
      case Op::dot_product_3d:
      case Op::dot_product_cube_map:
        return fetch(i, dot(1), dot(2), dot(3));
      case Op::dot_product_diffuse_cube_map: {
        const bool own = q_.profile.ahead_mapping.value == AheadMapping::own;
        return fetch(i, dot(1), dot(2), dot_of(3, mapping_of(own ? 3 : 2)));
      }
      case Op::dot_product_depth_replace:
        answer_.depth = dot(i - 1) / dot(i);
        return;
      case Op::dot_product_reflect_cube_map:
      case Op::dot_product_const_eye_reflect_cube_map: {
        std::array<float, 3> d{dot(1), dot(2), dot(3)}, e{}, r{};
        for (std::size_t k = 0; k < 3; ++k) {
          e[k] = op(i) == Op::dot_product_reflect_cube_map ? q_.coordinate[k + 1][3] : stage(i).eye[k];
        }
        const float de0 = d[0] * e[0], de1 = d[1] * e[1], de2 = d[2] * e[2];
        const float dd0 = d[0] * d[0], dd1 = d[1] * d[1], dd2 = d[2] * d[2];
        const float de = (de0 + de1) + de2, dd = (dd0 + dd1) + dd2;
        for (std::size_t k = 0; k < 3; ++k) r[k] = d[k] * (2.0F * de) - e[k] * dd;
        return fetch(i, r[0], r[1], r[2]);
      }
      default:
        return;
    }
  }

  void find_codes(int i) {
    Four color = answer_.texel[at(i)];
    if (q_.state.converts_yuv && fetched_[at(i)]) {
      const int y = color[0], u = color[1] - 128, v = color[2] - 128;
      const auto down = [](int n, int d) { return static_cast<int>(std::floor(static_cast<double>(n) / d)); };
      const auto clamp = [](int n) { return n < 0 ? 0 : n > 255 ? 255 : n; };
      const int f = down(298 * y, 256);
      color[0] = clamp(f + 2 * down(409 * v + 128, 512) - 19);
      color[1] = clamp(f - 2 * down(100 * u, 512) - 2 * down(208 * v, 512) - 18);
      color[2] = clamp(f + down(516 * u, 256) - 19);
    }
    const bool shows_texture = fetched_[at(i)];
    for (std::size_t k = 0; k < 4; ++k) {
      int code = color[k];
      if (shows_texture && q_.textures[at(i)]->is_signed[k]) code = 2 * complement(code, 256);
      if (shows_texture && gl()) {
        const TextureFormat format = q_.textures[at(i)]->format;
        const bool hidden = format == TextureFormat::hilo || format == TextureFormat::dsdt ||
                            format == TextureFormat::dsdt_mag ||
                            (format == TextureFormat::dsdt_mag_intensity && k != 3);
        if (hidden) code = 0;
      }
      answer_.code[at(i)][k] = code;
    }
  }

  const StageQuestion& q_;
  StageAnswer answer_;
  std::array<bool, 4> fetched_{};
};

}  // namespace

StageAnswer run_stages(const StageQuestion& question) {
  return Stages(question).run();
}

}  // namespace ninebit::oracle
