// Texture-shader stages as GLSL: a domain of the walk through a stage whose values are text.
#include <string>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/language/glsl.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/language/emit/emit_printer.h"
#include "src/system/digits.h"
#include "src/texture_shader/stage_walk.h"

namespace ninebit {
namespace {

// The helpers of each rule (stage_rules.inl), in the order in which they call each other, with $ for the name of the
// function that calls them.
constexpr std::string_view kTwelveBits = R"(
int $_byte(float c) {
  int n = c > 0.0 ? int(min(c * 4096.0, 4095.0)) : 0;
  return 255 * (n + 1) >> 12;
}
)";
constexpr std::string_view kNearest = R"(
int $_byte(float c) {
  return c > 0.0 ? int(min(c, 1.0) * 255.0 + 0.5) : 0;
}
)";
constexpr std::string_view kSigned8 = R"(
int $_s8(int v) { return (v ^ 128) - 128; }
)";
constexpr std::string_view kSigned16 = R"(
int $_s16(int v) { return (v ^ 32768) - 32768; }
)";
constexpr std::string_view kOffset = R"(
vec3 $_offset(vec4 at, ivec4 by, vec4 matrix) {
  float ds = float($_s8(by.b)) / 128.0, dt = float($_s8(by.g)) / 128.0;
  vec2 moved = at.xy + matrix.xy * ds;
  return vec3(moved + matrix.zw * dt, 0.0);
}
)";
constexpr std::string_view kScaled = R"(
ivec3 $_scaled(ivec4 texel, int luminance, vec2 scale_bias) {
  float factor = scale_bias.x * (float(luminance) / 255.0) + scale_bias.y;
  return ivec3($_byte(float(texel.r) / 255.0 * factor), $_byte(float(texel.g) / 255.0 * factor),
               $_byte(float(texel.b) / 255.0 * factor));
}
)";
constexpr std::string_view kDot = R"(
float $_dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
)";
constexpr std::string_view kHemisphere = R"(
vec3 $_hemisphere(ivec4 v) {
  int high = $_s16(256 * v.a + v.r), low = $_s16(256 * v.g + v.b);
  int left = 1073741824 - high * high - low * low, root = left > 0 ? int(sqrt(float(left))) : 0;
  if (left > 0 && root * root > left) --root;
  if (left > 0 && root < 32768 && (root + 1) * (root + 1) <= left) ++root;
  return vec3(float(high) / 32767.0, float(low) / 32767.0, float(root) / 32768.0);
}
)";
constexpr std::string_view kReflected = R"(
vec3 $_reflected(vec3 d, vec3 eye) {
  float along = 2.0 * $_dot(d, eye), length = $_dot(d, d);
  return vec3(d.x * along - eye.x * length, d.y * along - eye.y * length, d.z * along - eye.z * length);
}
)";
constexpr std::string_view kYuv = R"(
ivec4 $_rgb(ivec4 v) {
  int f = 298 * v.r >> 8;
  ivec3 rgb = ivec3(f + 2 * ((409 * (v.b - 128) + 128) >> 9) - 19,
                    f - 2 * (100 * (v.g - 128) >> 9) - 2 * (208 * (v.b - 128) >> 9) - 18,
                    f + (516 * (v.g - 128) >> 8) - 19);
  return ivec4(clamp(rgb, 0, 255), v.a);
}
)";

std::string number(float value) {
  std::string written = digits_of(value);
  // Infinity has no literal.
  if (written.find("inf") != std::string::npos) return value > 0.0F ? "(1.0 / 0.0)" : "(-1.0 / 0.0)";
  if (written.find_first_of(".e") == std::string::npos) written += ".0";
  return value < 0.0F || written.front() == '-' ? '(' + written + ')' : written;
}

template <std::size_t kCount>
std::string vector_of(const std::array<float, kCount>& values) {
  std::string text = "vec" + std::to_string(kCount) + '(';
  for (std::size_t k = 0; k < kCount; ++k) text += (k == 0 ? "" : ", ") + number(values[k]);
  return text + ')';
}

std::string indexed(const char* name, int i) {
  return name + std::to_string(i);
}

class GlslStages {
 public:
  using At = std::string;

  GlslStages(const TextureShaderProgram& program, const HardwareProfile& profile, std::string_view function,
             StageNumbers numbers)
      : program_(program), profile_(profile), function_(function), numbers_(numbers) {
    for (int i = 0; i < kTextureStages; ++i) walk_stage(program_, i, *this);
    for (int i = 0; i < kTextureStages; ++i) finish(i);
  }

  [[nodiscard]] static At projected(int i) { return indexed("at", i) + ".xyz / " + indexed("at", i) + ".w"; }
  [[nodiscard]] static At coordinates(int i) { return indexed("at", i) + ".xyz"; }
  [[nodiscard]] At offset(int i, const TextureStage& stage) const {
    return call("_offset(" + indexed("at", i) + ", " + indexed("texel", stage.previous) + ", " +
                set("_matrix", i, vector_of(stage.matrix)) + ')');
  }
  [[nodiscard]] At dependent(int /*i*/, const TextureStage& stage, int first, int second) const {
    const auto at = [&](int k) {
      return "float(" + indexed("texel", stage.previous) + '.' + "rgba"[k] + ") / " +
             number(static_cast<float>(program_.choices.dependent_divisor));
    };
    return "vec3(" + at(first) + ", " + at(second) + ", 0.0)";
  }
  void dot(int i, const TextureStage& stage) {
    const auto [vector, over] = factor(indexed("texel", stage.previous), stage.mapping);
    line(indexed("dot", i) + " = " + call("_dot(" + indexed("at", i) + ".xyz, " + vector + ')') +
         (over == 1 ? "" : " / " + number(static_cast<float>(over))));
  }
  [[nodiscard]] static At dots(int first, int count) {
    return "vec3(" + indexed("dot", first) + ", " + indexed("dot", first + 1) + ", " +
           (count == 3 ? indexed("dot", first + 2) : "0.0") + ')';
  }
  [[nodiscard]] At reflected(int i, const TextureStage& stage, bool is_constant) const {
    const std::string eye = is_constant ? set("_eye", i, vector_of(stage.eye))
                                        : "vec3(" + indexed("at", i - 2) + ".w, " + indexed("at", i - 1) + ".w, " +
                                              indexed("at", i) + ".w)";
    return call("_reflected(" + dots(i - 2, 3) + ", " + eye + ')');
  }
  void fetch(int i, const At& at) {
    reads_[static_cast<std::size_t>(i)] = true;
    line(indexed("texel", i) + " = " + call(indexed("_texel", i) + '(' + at + ')'));
  }
  void scale(int i, const TextureStage& stage) {
    line(indexed("texel", i) + ".rgb = " +
         call("_scaled(" + indexed("texel", i) + ", " + indexed("texel", stage.previous) + ".r, " +
              set("_scale", i, vector_of(std::array{stage.scale, stage.bias})) + ')'));
  }
  void pass(int i) {
    std::string bytes;
    for (const char c : std::string_view("xyzw")) {
      bytes += (bytes.empty() ? "" : ", ") + call("_byte(" + indexed("at", i) + '.' + c + ')');
    }
    line(indexed("texel", i) + " = ivec4(" + bytes + ')');
  }
  void cull(int i, const TextureStage& stage) {
    std::string kills;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool negative = stage.cull[k] == CullMode::kills_negative;
      const std::string c = indexed("at", i) + '.' + "xyzw"[k], compared = c + (negative ? " < 0.0" : " >= 0.0");
      const std::string minus_zero = "(floatBitsToInt(" + c + ") == int(0x80000000u))";
      const bool by_sign = program_.choices.cull_zero == CullZero::by_sign;
      kills += kills.empty() ? "" : " || ";
      kills += by_sign ? "(" + compared + (negative ? " || " : " && !") + minus_zero + ")" : compared;
    }
    line("culled = culled || " + kills);
  }
  void replace_depth(int i) { line("depth = " + indexed("dot", i - 1) + " / " + indexed("dot", i)); }
  void nothing(int /*i*/) {}  // the value at the start
  void off(int i) {
    if (program_.choices.off_alpha != 0) {
      line(indexed("texel", i) + ".a = " + std::to_string(program_.choices.off_alpha));
    }
  }

  [[nodiscard]] std::string text() const {
    std::string body;
    if (numbers_ == StageNumbers::uniform) {
      for (const auto& [name, type] : {std::pair{"_matrix", "vec4"}, {"_scale", "vec2"}, {"_eye", "vec3"}}) {
        body += std::string("uniform ") + type + ' ' + function_ + name + "[4];\n";
      }
    }
    for (int i = 0; i < kTextureStages; ++i) {
      if (reads_[static_cast<std::size_t>(i)]) body += "ivec4 " + call(indexed("_texel", i)) + "(vec3 at);\n";
    }
    body += helpers();
    const std::string indent(function_.size() + 6, ' ');
    body += "\nbool " + function_ + "(vec4 at0, vec4 at1, vec4 at2, vec4 at3,\n" + indent +
            "out ivec4 texture0, out ivec4 texture1, out ivec4 texture2, out ivec4 texture3,\n" + indent +
            "out float depth) {\n"
            "  ivec4 texel0 = ivec4(0), texel1 = ivec4(0), texel2 = ivec4(0), texel3 = ivec4(0);\n"
            "  float dot0 = 0.0, dot1 = 0.0, dot2 = 0.0, dot3 = 0.0;\n"
            "  bool culled = false;\n"
            "  depth = 0.0;\n";
    return body + lines_ + "  return culled;\n}\n";
  }

 private:
  void line(const std::string& text) { lines_ += "  " + text + ";\n"; }
  [[nodiscard]] std::string call(const std::string& rest) const { return function_ + rest; }
  // A number of a stage, or its uniform.
  [[nodiscard]] std::string set(const char* name, int i, const std::string& literal) const {
    return numbers_ == StageNumbers::literal ? literal : function_ + name + '[' + std::to_string(i) + ']';
  }

  struct Factor {
    std::string vector;
    int over;
  };
  // Rule 36.
  [[nodiscard]] Factor factor(const std::string& texel, DotMapping mapping) const {
    const bool is_odd = program_.choices.divisors == DotDivisors::odd;
    const auto each = [&](const std::string& before, const std::string& after) {
      std::string parts;
      for (const char c : std::string_view("rgb")) {
        parts += (parts.empty() ? "" : ", ") + before + texel + '.' + c + after;
      }
      return "vec3(" + parts + ')';
    };
    const std::string s8 = call("_s8(");
    switch (mapping) {
      case DotMapping::minus1_to_1_d3d:
        return {each("", " - 128"), is_odd ? 127 : 128};
      case DotMapping::minus1_to_1_gl:
        return {each("2 * " + s8, ") + 1"), is_odd ? 255 : 256};
      case DotMapping::minus1_to_1:
        return {each(s8, ")"), is_odd ? 127 : 128};
      case DotMapping::hilo_1:
        return {"vec3(float(256 * " + texel + ".a + " + texel + ".r) / 65535.0, float(256 * " + texel + ".g + " +
                    texel + ".b) / 65535.0, 1.0)",
                1};
      case DotMapping::hilo_hemisphere:
        return {call("_hemisphere(" + texel + ')'), 1};
      case DotMapping::zero_to_one:
      case DotMapping::hilo_hemisphere_d3d:
      case DotMapping::hilo_hemisphere_gl:
        break;
    }
    return {each("", ""), 255};
  }

  // The codes that the combiners read.
  void finish(int i) {
    const ProgramTextureStage& stage = program_.stage[static_cast<std::size_t>(i)];
    std::string shown = indexed("texel", i);
    if (program_.converts_yuv && reads_[static_cast<std::size_t>(i)]) {
      line("ivec4 " + indexed("shown", i) + " = " + call("_rgb(" + shown + ')'));
      shown = indexed("shown", i);
    }
    const int shift = profile_.byte_shift.value;
    const std::string down = shift == 0 ? "" : " >> " + std::to_string(shift);
    std::string codes;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::string byte = shown + '.' + "rgba"[k];
      std::string code = "0";
      if (stage.is_visible[k] && stage.is_signed[k]) {
        const std::string twice = "2 * " + call("_s8(" + byte + ')');
        code = "max(" + (shift == 0 ? twice : '(' + twice + ')' + down) + ", " + std::to_string(profile_.lowest.value) +
               ')';
      } else if (stage.is_visible[k]) {
        code = byte + down;
      }
      codes += (codes.empty() ? "" : ", ") + code;
    }
    line(indexed("texture", i) + " = ivec4(" + codes + ')');
  }

  // Those that are called, each after those that it calls.
  [[nodiscard]] std::string helpers() const {
    const std::string byte = emit::byte_helper(program_.choices.byte == StageByte::nearest ? kNearest : kTwelveBits,
                                               program_.choices.negative, "abs(c)");
    const std::array<emit::Helper, 9> all{{{"_byte(", byte},
                                           {"_s8(", kSigned8},
                                           {"_s16(", kSigned16},
                                           {"_offset(", kOffset},
                                           {"_scaled(", kScaled},
                                           {"_dot(", kDot},
                                           {"_hemisphere(", kHemisphere},
                                           {"_reflected(", kReflected},
                                           {"_rgb(", kYuv}}};
    return emit::called_helpers(all, function_, lines_);
  }

  const TextureShaderProgram& program_;
  const HardwareProfile& profile_;
  std::string function_;
  StageNumbers numbers_;
  std::string lines_;
  std::array<bool, kTextureStages> reads_{};
};

}  // namespace

Result<std::string> emit_glsl_texture_shader(const TextureShaderProgram& program, const HardwareProfile& profile,
                                             StageNumbers numbers, std::string_view function) {
  if (auto fault = emit::refused_name(function)) return *fault;
  return GlslStages(program, profile, function, numbers).text();
}

}  // namespace ninebit
