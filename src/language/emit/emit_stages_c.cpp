// Texture-shader stages as C99: a domain of the walk through a stage whose values are text.
#include <cmath>
#include <string>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/language/c_source.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/language/emit/emit_printer.h"
#include "src/system/digits.h"
#include "src/texture_shader/stage_walk.h"

namespace ninebit {
namespace {

// The helpers of each rule (stage_rules.inl), in the order in which they call each other, with $ for the name of the
// function that calls them. A statement has one rounding at most, so that no compiler contracts two of them.
constexpr std::string_view kCTwelveBits = R"(
static int32_t $_byte(float c) {
  const float scaled = c * 4096.0F;
  const int32_t n = scaled > 0.0F ? (int32_t)(scaled < 4095.0F ? scaled : 4095.0F) : 0;
  return 255 * (n + 1) >> 12;
}
)";
constexpr std::string_view kCNearest = R"(
static int32_t $_byte(float c) {
  const float scaled = (c < 1.0F ? c : 1.0F) * 255.0F;
  return c > 0.0F ? (int32_t)(scaled + 0.5F) : 0;
}
)";
constexpr std::string_view kCSigned8 = R"(
static int32_t $_s8(int32_t v) { return (v ^ 128) - 128; }
)";
constexpr std::string_view kCMoved = R"(
static float $_moved(float at, float by_ds, float by_dt, const int32_t by[4]) {
  const float ds = by_ds * ((float)$_s8(by[2]) / 128.0F), dt = by_dt * ((float)$_s8(by[1]) / 128.0F);
  const float moved = at + ds;
  return moved + dt;
}
)";
constexpr std::string_view kCScaled = R"(
static int32_t $_scaled(int32_t texel, int32_t luminance, float scale, float bias) {
  const float scaled = scale * ((float)luminance / 255.0F);
  const float factor = scaled + bias;
  return $_byte((float)texel / 255.0F * factor);
}
)";
constexpr std::string_view kCDot = R"(
static float $_dot(float a, float b, float c, float x, float y, float z) {
  const float ax = a * x, by = b * y, cz = c * z;
  const float sum = ax + by;
  return sum + cz;
}
)";
constexpr std::string_view kCHemisphere = R"(
static void $_hemisphere(const int32_t v[4], float n[3]) {
  const int32_t high = ((256 * v[3] + v[0]) ^ 32768) - 32768, low = ((256 * v[1] + v[2]) ^ 32768) - 32768;
  const int64_t left = 1073741824 - (int64_t)high * high - (int64_t)low * low;
  int32_t root = 0, bit;
  for (bit = 32768; bit > 0; bit /= 2) {
    if ((int64_t)(root + bit) * (root + bit) <= left) root += bit;
  }
  n[0] = (float)high / 32767.0F;
  n[1] = (float)low / 32767.0F;
  n[2] = (float)root / 32768.0F;
}
)";
constexpr std::string_view kCReflected = R"(
static void $_reflected(float x, float y, float z, float ex, float ey, float ez, float to[3]) {
  const float along = 2.0F * $_dot(x, y, z, ex, ey, ez), length = $_dot(x, y, z, x, y, z);
  const float dx = x * along, dy = y * along, dz = z * along;
  const float lx = ex * length, ly = ey * length, lz = ez * length;
  to[0] = dx - lx;
  to[1] = dy - ly;
  to[2] = dz - lz;
}
)";
constexpr std::string_view kCYuv = R"(
static int32_t $_down(int32_t v, int32_t bits) { return ((v + 16777216) >> bits) - (16777216 >> bits); }
static int32_t $_clamped(int32_t v) { return v < 0 ? 0 : v > 255 ? 255 : v; }
static void $_rgb(const int32_t v[4], int32_t to[4]) {
  const int32_t f = 298 * v[0] >> 8, u = v[1] - 128, w = v[2] - 128;
  to[0] = $_clamped(f + 2 * $_down(409 * w + 128, 9) - 19);
  to[1] = $_clamped(f - 2 * $_down(100 * u, 9) - 2 * $_down(208 * w, 9) - 18);
  to[2] = $_clamped(f + $_down(516 * u, 8) - 19);
  to[3] = v[3];
}
)";

std::string c_number(float value) {
  // These have no literals.
  if (std::isnan(value)) return "(0.0F / 0.0F)";
  if (std::isinf(value)) return value > 0.0F ? "(1.0F / 0.0F)" : "(-1.0F / 0.0F)";
  std::string written = digits_of(value);
  if (written.find_first_of(".e") == std::string::npos) written += ".0";
  written += 'F';
  return written.front() == '-' ? '(' + written + ')' : written;
}

class CStages {
 public:
  struct At {
    std::string s, t, r;
  };

  CStages(const TextureShaderProgram& program, const HardwareProfile& profile, std::string_view function)
      : program_(program), profile_(profile), function_(function) {
    for (int i = 0; i < kTextureStages; ++i) walk_stage(program_, i, *this);
    for (int i = 0; i < kTextureStages; ++i) finish(i);
    for (int i = 0; i < kTextureStages; ++i) drop_unread_dot(i);
  }

  [[nodiscard]] static At projected(int i) {
    const auto over = [&](int k) { return at(i, k) + " / " + at(i, 3); };
    return {over(0), over(1), over(2)};
  }
  [[nodiscard]] static At coordinates(int i) { return {at(i, 0), at(i, 1), at(i, 2)}; }
  [[nodiscard]] At offset(int i, const TextureStage& stage) const {
    const auto moved = [&](int k) {
      const auto entry = [&](int j) { return c_number(stage.matrix[static_cast<std::size_t>(j)]); };
      return call("_moved(" + at(i, k) + ", " + entry(k) + ", " + entry(k + 2) + ", " + texel(stage.previous) + ')');
    };
    return {moved(0), moved(1), "0.0F"};
  }
  [[nodiscard]] At dependent(int /*i*/, const TextureStage& stage, int first, int second) const {
    const auto over = [&](int k) {
      return "(float)" + texel(stage.previous, k) + " / " +
             c_number(static_cast<float>(program_.choices.dependent_divisor));
    };
    return {over(first), over(second), "0.0F"};
  }
  void dot(int i, const TextureStage& stage) {
    const auto [x, y, z, over] = factor(stage);
    line(dot(i) + " = " + call("_dot(" + at(i, 0) + ", " + at(i, 1) + ", " + at(i, 2) + ", ") + x + ", " + y + ", " +
         z + ')' + (over == 1 ? "" : " / " + c_number(static_cast<float>(over))));
  }
  [[nodiscard]] static At dots(int first, int count) {
    return {dot(first), dot(first + 1), count == 3 ? dot(first + 2) : "0.0F"};
  }
  At reflected(int i, const TextureStage& stage, bool is_constant) {
    std::string eye;
    for (int k = 0; k < 3; ++k) {
      eye += ", " + (is_constant ? c_number(stage.eye[static_cast<std::size_t>(k)]) : at(i - 2 + k, 3));
    }
    line(call("_reflected(" + dot(i - 2) + ", " + dot(i - 1) + ", " + dot(i) + eye + ", place)"));
    return {};  // in `place` already
  }
  void fetch(int i, const At& to) {
    if (!to.s.empty()) line("place[0] = " + to.s + "; place[1] = " + to.t + "; place[2] = " + to.r);
    line("texel(data, " + std::to_string(i) + ", place, " + texel(i) + ')');
    reads_[static_cast<std::size_t>(i)] = true;
  }
  void scale(int i, const TextureStage& stage) {
    for (int k = 0; k < 3; ++k) {
      line(texel(i, k) + " = " + call("_scaled(" + texel(i, k) + ", " + texel(stage.previous, 0) + ", ") +
           c_number(stage.scale) + ", " + c_number(stage.bias) + ')');
    }
  }
  void pass(int i) {
    for (int k = 0; k < 4; ++k) line(texel(i, k) + " = " + call("_byte(" + at(i, k) + ')'));
  }
  void cull(int i, const TextureStage& stage) {
    std::string kills;
    for (int k = 0; k < 4; ++k) {
      const bool negative = stage.cull[static_cast<std::size_t>(k)] == CullMode::kills_negative;
      const std::string c = at(i, k), compared = c + (negative ? " < 0.0F" : " >= 0.0F");
      const std::string minus_zero = "(" + c + " == 0.0F && 1.0F / " + c + " < 0.0F)";
      const bool by_sign = program_.choices.cull_zero == CullZero::by_sign;
      kills += k == 0 ? "" : " || ";
      kills += by_sign ? "(" + compared + (negative ? " || " : " && !") + minus_zero + ")" : compared;
    }
    line("culled = culled || " + kills);
  }
  void replace_depth(int i) { line("*depth = " + dot(i - 1) + " / " + dot(i)); }
  void nothing(int /*i*/) {}  // the value at the start
  void off(int i) {
    if (program_.choices.off_alpha != 0) line(texel(i, 3) + " = " + std::to_string(program_.choices.off_alpha));
  }

  [[nodiscard]] std::string text() const {
    const std::string indent(function_.size() + 5, ' ');
    std::string body = helpers();
    body += "\nint " + function_ +
            "(const float at0[4], const float at1[4], const float at2[4], const float at3[4],\n" + indent +
            "void (*texel)(void *data, int unit, const float at[3], int32_t rgba[4]), void *data,\n" + indent +
            "int32_t texture0[4], int32_t texture1[4], int32_t texture2[4], int32_t texture3[4],\n" + indent +
            "float *depth) {\n";
    for (int i = 0; i < kTextureStages; ++i) {
      if (uses("texel" + std::to_string(i) + '[') || uses(texel(i) + ')') || uses(texel(i) + ',')) {
        body += "  int32_t " + texel(i) + "[4] = {0, 0, 0, 0};\n";
      }
      if (uses(dot(i))) body += "  float " + dot(i) + " = 0.0F;\n";
      if (uses("shown" + std::to_string(i))) body += "  int32_t shown" + std::to_string(i) + "[4];\n";
    }
    for (const char* three : {"normal", "place"}) {
      if (uses(three)) body += std::string("  float ") + three + "[3];\n";
    }
    body += "  int culled = 0;\n";
    for (int i = 0; i < kTextureStages; ++i) {
      if (!uses("at" + std::to_string(i) + '[')) body += "  (void)at" + std::to_string(i) + ";\n";
    }
    if (!uses("texel(data")) body += "  (void)texel;\n  (void)data;\n";
    return body + "  *depth = 0.0F;\n" + lines_ + "  return culled;\n}\n";
  }

 private:
  [[nodiscard]] static std::string at(int i, int k) { return "at" + std::to_string(i) + '[' + std::to_string(k) + ']'; }
  [[nodiscard]] static std::string texel(int i) { return "texel" + std::to_string(i); }
  [[nodiscard]] static std::string texel(int i, int k) { return texel(i) + '[' + std::to_string(k) + ']'; }
  [[nodiscard]] static std::string dot(int i) { return "dot" + std::to_string(i); }
  void line(const std::string& text) { lines_ += "  " + text + ";\n"; }
  [[nodiscard]] std::string call(const std::string& rest) const { return function_ + rest; }
  [[nodiscard]] bool uses(const std::string& text) const { return lines_.find(text) != std::string::npos; }

  // Drops the lines that set a dot product if no other line reads it.
  void drop_unread_dot(int i) {
    std::string kept;
    for (std::size_t begin = 0; begin < lines_.size();) {
      const std::size_t end = lines_.find('\n', begin) + 1;
      const std::string_view one = std::string_view(lines_).substr(begin, end - begin);
      begin = end;
      if (one.starts_with("  " + dot(i) + " = ")) continue;
      if (one.find(dot(i)) != std::string_view::npos) return;
      kept += one;
    }
    lines_ = kept;
  }

  struct Factor {
    std::string x, y, z;
    int over;
  };
  // Rule 36.
  Factor factor(const TextureStage& stage) {
    const bool is_odd = program_.choices.divisors == DotDivisors::odd;
    const int from = stage.previous;
    const auto each = [&](const std::string& before, const std::string& after, int over) {
      const auto one = [&](int k) { return "(float)(" + before + texel(from, k) + after + ')'; };
      return Factor{one(0), one(1), one(2), over};
    };
    const std::string s8 = call("_s8(");
    switch (stage.mapping) {
      case DotMapping::minus1_to_1_d3d:
        return each("", " - 128", is_odd ? 127 : 128);
      case DotMapping::minus1_to_1_gl:
        return each("2 * " + s8, ") + 1", is_odd ? 255 : 256);
      case DotMapping::minus1_to_1:
        return each(s8, ")", is_odd ? 127 : 128);
      case DotMapping::hilo_1: {
        const auto word = [&](int high, int low) {
          return "(float)(256 * " + texel(from, high) + " + " + texel(from, low) + ") / 65535.0F";
        };
        return {word(3, 0), word(1, 2), "1.0F", 1};
      }
      case DotMapping::hilo_hemisphere:
        line(call("_hemisphere(" + texel(from) + ", normal)"));
        return {"normal[0]", "normal[1]", "normal[2]", 1};
      case DotMapping::zero_to_one:
      case DotMapping::hilo_hemisphere_d3d:
      case DotMapping::hilo_hemisphere_gl:
        break;
    }
    return each("", "", 255);
  }

  // The codes that the combiners read.
  void finish(int i) {
    const ProgramTextureStage& stage = program_.stage[static_cast<std::size_t>(i)];
    std::string shown = texel(i);
    if (program_.converts_yuv && reads_[static_cast<std::size_t>(i)]) {
      shown = "shown" + std::to_string(i);
      line(call("_rgb(" + texel(i) + ", " + shown + ')'));
    }
    const int shift = profile_.byte_shift.value;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::string byte = shown + '[' + std::to_string(k) + ']';
      std::string code = "0";
      if (stage.is_visible[k] && stage.is_signed[k]) {
        code = call("_code(" + byte + ')');
      } else if (stage.is_visible[k]) {
        code = shift == 0 ? byte : byte + " >> " + std::to_string(shift);
      }
      line("texture" + std::to_string(i) + '[' + std::to_string(k) + "] = " + code);
    }
  }

  // The code of a signed byte: twice the byte, divided and rounded down, at least the lowest code.
  [[nodiscard]] std::string code_helper() const {
    const std::string shift = std::to_string(profile_.byte_shift.value), lowest = std::to_string(profile_.lowest.value);
    return "\nstatic int32_t $_code(int32_t byte) {\n  const int32_t code = ((2 * $_s8(byte) + 256) >> " + shift +
           ") - (256 >> " + shift + ");\n  return code > " + lowest + " ? code : " + lowest + ";\n}\n";
  }

  // Those that are called, each after those that it calls.
  [[nodiscard]] std::string helpers() const {
    const std::string code = code_helper(),
                      byte = emit::byte_helper(program_.choices.byte == StageByte::nearest ? kCNearest : kCTwelveBits,
                                               program_.choices.negative, "c < 0.0F ? -c : c");
    const std::array<emit::Helper, 9> all{{{"_byte(", byte},
                                           {"_s8(", kCSigned8},
                                           {"_code(", code},
                                           {"_moved(", kCMoved},
                                           {"_scaled(", kCScaled},
                                           {"_dot(", kCDot},
                                           {"_hemisphere(", kCHemisphere},
                                           {"_reflected(", kCReflected},
                                           {"_rgb(", kCYuv}}};
    return emit::called_helpers(all, function_, lines_);
  }

  const TextureShaderProgram& program_;
  const HardwareProfile& profile_;
  std::string function_;
  std::string lines_;
  std::array<bool, kTextureStages> reads_{};
};

}  // namespace

Result<std::string> emit_c_texture_shader(const TextureShaderProgram& program, const HardwareProfile& profile,
                                          std::string_view function) {
  if (auto fault = emit::refused_name(function)) return *fault;
  return "#include <stdint.h>\n\n// Texture-shader stages; a byte is a code, a signed one is two codes. To be compiled "
         "without contraction of\n// floats (-ffp-contract=off).\n" +
         CStages(program, profile, function).text();
}

}  // namespace ninebit
