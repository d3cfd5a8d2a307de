#include "combiner_tests/oracle/texture_oracle.h"

#include <cmath>
#include <cstdlib>

namespace ninebit::oracle {
namespace {

// Exact numbers in units of 2^-80; floats with bits below that are tiny and rounded down.
using Exact = __int128;
constexpr int kPoint = 80;
constexpr Exact kOne = Exact{1} << kPoint;

Exact floor_shift(Exact value, int right) {
  if (right > 126) return value < 0 ? -1 : 0;
  return value >> right;
}

Exact exact_of(float value) {  // below 2^26
  int exponent = 0;
  const auto mantissa = static_cast<Exact>(std::ldexp(std::frexp(value, &exponent), 24));
  const int left = exponent - 24 + kPoint;
  return left >= 0 ? mantissa * (Exact{1} << left) : floor_shift(mantissa, -left);
}

Exact clamp_exact(Exact value, Exact low, Exact high) {
  return value < low ? low : value > high ? high : value;
}

// The coordinate after wrapping, in [0, 1].
Exact wrap_coordinate(float s, Wrap wrap, int size) {
  const Exact half_texel = kOne / (2 * size);
  if (std::isnan(s)) s = 0;
  const bool cyclic = wrap == Wrap::repeat || wrap == Wrap::mirrored_repeat;
  // Floats from 2^24 on are even integers, and infinity is to read as 0.
  if (std::fabs(s) >= 16777216.0F) s = cyclic ? 0.0F : std::copysign(2.0F, s);
  const Exact x = exact_of(s);
  const Exact whole = floor_shift(x, kPoint);
  const Exact fraction = x - whole * kOne;
  switch (wrap) {
    case Wrap::repeat:
      return fraction;
    case Wrap::clamp:
      return clamp_exact(x, 0, kOne);
    case Wrap::clamp_to_edge:
      return clamp_exact(x, half_texel, kOne - half_texel);
    case Wrap::clamp_to_border:
      return clamp_exact(x, -2 * half_texel, kOne + 2 * half_texel);
    case Wrap::mirrored_repeat:
      return clamp_exact(whole % 2 == 0 ? fraction : kOne - fraction, half_texel, kOne - half_texel);
  }
  std::abort();
}

// A rectangle's coordinate in texels. All that would repeat is clamped to the edge.
Exact rectangle_position(float s, Wrap wrap, int size) {
  if (std::isnan(s)) s = 0;
  if (std::fabs(s) >= 16777216.0F) s = std::copysign(1048576.0F, s);
  const Exact x = exact_of(s), end = kOne * size;
  if (wrap == Wrap::clamp) return clamp_exact(x, 0, end);
  if (wrap == Wrap::clamp_to_border) return clamp_exact(x, -kOne, end + kOne);
  return clamp_exact(x, kOne / 2, end - kOne / 2);
}

// A quotient, rounded down.
Exact floor_divide(Exact a, Exact b) {
  const Exact quotient = a / b;
  return a % b != 0 && (a < 0) != (b < 0) ? quotient - 1 : quotient;
}

struct Neighbour {
  int index = 0;  // -1 and size: outside
  Exact weight = 0;
};

// The texels along one axis, with weights that add up to 2^bits (LINEAR) or to 1.
std::vector<Neighbour> neighbours(Exact u, Wrap wrap, int size, bool linear, int bits, bool cut) {
  if (!linear) {
    const auto index = static_cast<int>(floor_shift(u, kPoint));
    return {{index == size && wrap != Wrap::clamp_to_border ? size - 1 : index, 1}};
  }
  const Exact steps = Exact{1} << bits;
  const Exact rounded = floor_shift((u - kOne / 2) * steps + (cut ? 0 : kOne / 2), kPoint);  // u - 1/2 in 1/2^bits
  auto first = static_cast<int>(floor_shift(rounded, bits));
  const Exact weight = rounded - Exact{first} * steps;
  int second = first + 1;
  if (wrap == Wrap::repeat) {
    first = (first + size) % size;
    second = second % size;
  }
  return {{first, steps - weight}, {second, weight}};
}

struct Direction {
  std::size_t face = 0;
  std::array<int, 3> axis{};  // of sc, tc, ma
  std::array<int, 3> sign{};
};

// The table of ARB_texture_cube_map; x wins over y and y over z, and a zero is positive.
Direction face_of(const std::array<float, 3>& r) {
  const float x = std::fabs(r[0]), y = std::fabs(r[1]), z = std::fabs(r[2]);
  if (std::isnan(r[0]) || std::isnan(r[1]) || std::isnan(r[2])) return {0, {2, 1, 0}, {-1, -1, 1}};
  if (x >= y && x >= z) {
    return r[0] < 0 ? Direction{1, {2, 1, 0}, {1, -1, -1}} : Direction{0, {2, 1, 0}, {-1, -1, 1}};
  }
  if (y >= z) return r[1] < 0 ? Direction{3, {0, 2, 1}, {1, -1, -1}} : Direction{2, {0, 2, 1}, {1, 1, 1}};
  return r[2] < 0 ? Direction{5, {0, 1, 2}, {-1, -1, -1}} : Direction{4, {0, 1, 2}, {1, -1, 1}};
}

float picked(const Direction& d, std::size_t which, const std::array<float, 3>& v) {
  return static_cast<float>(d.sign[which]) * v[static_cast<std::size_t>(d.axis[which])];
}

float face_coordinate(const Direction& d, std::size_t which, const std::array<float, 3>& r) {
  if (std::isnan(r[0]) || std::isnan(r[1]) || std::isnan(r[2])) return 0.0F;
  const float ma = picked(d, 2, r);
  if (ma == 0) return 0.0F;
  const float divided = picked(d, which, r) / ma;
  const float shifted = divided + 1.0F;
  const float place = shifted * 0.5F;
  return std::isnan(place) ? 0.0F : place;
}

double face_change(const Direction& d, std::size_t which, const std::array<float, 3>& r,
                   const std::array<float, 3>& change) {
  const double ma = static_cast<double>(picked(d, 2, r));
  const double place = static_cast<double>(picked(d, which, r)) / ma;
  const double moved =
      static_cast<double>(picked(d, which, change)) - place * static_cast<double>(picked(d, 2, change));
  return 0.5 * moved / ma;
}

constexpr int kNever = 1 << 20;  // beyond any level of detail

// The levels of detail in 1/256 that rho squared may stand for, before the bias.
std::vector<int> levels_of_detail(double rho_squared) {
  if (!(rho_squared > 0)) return {-kNever};
  if (std::isinf(rho_squared)) return {kNever};
  int exponent = 0;
  if (std::frexp(rho_squared, &exponent) == 0.5) return {128 * (exponent - 1)};
  const long double exact = 128.0L * std::log2(static_cast<long double>(rho_squared));
  const auto low = static_cast<int>(std::floor(exact - 1e-9L)), high = static_cast<int>(std::floor(exact + 1e-9L));
  if (low == high) return {low};
  return {low, high};
}

std::uint32_t to_code(float value, std::uint32_t largest) {
  if (!(value > 0)) return 0;
  if (value > 1) value = 1;
  return static_cast<std::uint32_t>(std::floor(static_cast<long double>(value) * largest + 0.5L));
}

long double half_value(std::uint16_t bits) {
  const int exponent = (bits >> 10) & 31, mantissa = bits & 1023;
  const long double sign = (bits >> 15) != 0 ? -1 : 1;
  if (exponent == 31) return mantissa != 0 ? std::nanl("") : sign * HUGE_VALL;
  if (exponent == 0) return sign * std::ldexp(static_cast<long double>(mantissa), -24);
  return sign * std::ldexp(static_cast<long double>(1024 + mantissa), exponent - 25);
}

// The whole answer for one level of detail.
class Model {
 public:
  Model(const TextureQuestion& q, int lambda)
      : q_(q), texture_(*q.texture), lambda_(lambda), place_{q.coordinate[0], q.coordinate[1]} {
    cube_ = texture_.target == TextureTarget::cube_map;
    if (cube_) {
      const Direction d = face_of(q.coordinate);
      face_ = d.face;
      place_ = {face_coordinate(d, 0, q.coordinate), face_coordinate(d, 1, q.coordinate)};
    }
    volume_ = texture_.target == TextureTarget::texture_3d;
    words_ = texture_.format == InternalFormat::hilo16;
    find_signs();
    depth_ = texture_.format == InternalFormat::depth16 || texture_.format == InternalFormat::depth24;
    largest_ = texture_.format == InternalFormat::depth16 ? 65535 : depth_ ? 16777215 : 255;
  }

  TextureAnswer answer() {
    const MinFilter min = q_.sampler.min_filter;
    const bool mag_linear = q_.sampler.mag_filter == MagFilter::linear;
    const bool late =
        mag_linear && (min == MinFilter::nearest_mipmap_nearest || min == MinFilter::nearest_mipmap_linear);
    const int q = static_cast<int>(texture_.faces[0].size()) - 1;
    if (lambda_ <= (late ? 128 : 0)) {
      read(0, mag_linear, 1, 0);
    } else if (min == MinFilter::nearest || min == MinFilter::linear) {
      read(0, min == MinFilter::linear, 1, 0);
    } else if (min == MinFilter::nearest_mipmap_nearest || min == MinFilter::linear_mipmap_nearest) {
      int level = 0;  // the one that lambda lies within half a level of; halves go to the finer
      while (level < q && lambda_ > 256 * level + 128) ++level;
      read(level, min == MinFilter::linear_mipmap_nearest, 1, 0);
    } else {
      const bool linear = min == MinFilter::linear_mipmap_linear;
      const Exact steps = Exact{1} << q_.weight_bits;
      int level = 0;
      while (level < q && lambda_ >= 256 * (level + 1)) ++level;
      const Exact second = level == q ? 0 : Exact{lambda_ - 256 * level} * steps / 256;
      read(level, linear, steps - second, q_.weight_bits);
      if (second != 0) read(level + 1, linear, second, q_.weight_bits);
      second_ = second;
      answer_.level = level;
    }
    return finish();
  }

 private:
  void find_signs() {
    is_signed_ = q_.sampler.is_signed;
    const bool dsdt = texture_.format == InternalFormat::dsdt8 || texture_.format == InternalFormat::dsdt8_mag8 ||
                      texture_.format == InternalFormat::dsdt8_mag8_intensity8;
    if (dsdt) is_signed_[1] = is_signed_[2] = true;
    if (!std::holds_alternative<std::array<Plane<const std::uint8_t>, 4>>(texture_.faces[0][0].planes)) is_signed_ = {};
  }

  std::vector<Neighbour> along(float place, Wrap wrap, int size, bool linear) const {
    if (q_.sampler.border_texels) return along_stored(place, wrap, size, linear);
    const bool rectangle = texture_.target == TextureTarget::rectangle;
    const Exact u = rectangle ? rectangle_position(place, wrap, size) : wrap_coordinate(place, wrap, size) * size;
    return neighbours(u, wrap, size, linear, q_.weight_bits, q_.cuts_weights);
  }

  // A texture of half the image's size, whose texel i is stored at i + 4. The border mode reads what is stored outside,
  // as far as that goes; the colour of other modes is outside of the image.
  std::vector<Neighbour> along_stored(float place, Wrap wrap, int stored, bool linear) const {
    const int size = stored / 2;
    const float near = place > 4 ? 4 : place < -4 ? -4 : std::isnan(place) ? 0 : place;
    const Exact u = (wrap == Wrap::clamp_to_border ? exact_of(near) : wrap_coordinate(place, wrap, size)) * size;
    std::vector<Neighbour> found = neighbours(u, wrap, size, linear, q_.weight_bits, q_.cuts_weights);
    for (Neighbour& n : found) {
      const bool outside = n.index < 0 || n.index >= size;
      n.index += 4;
      if (wrap == Wrap::clamp_to_border) n.index = n.index < 0 ? 0 : n.index >= stored ? stored - 1 : n.index;
      if (wrap != Wrap::clamp_to_border && outside) n.index = -1;
    }
    return found;
  }

  void read(int level, bool linear, Exact weight, int weight_shift) {
    const TextureImage& image = texture_.faces[face_][static_cast<std::size_t>(level)];
    const auto along_s = along(place_[0], q_.sampler.wrap_s, image.width, linear);
    auto along_t = along(place_[1], q_.sampler.wrap_t, image.height, linear);
    if (texture_.target == TextureTarget::texture_1d) along_t = {{0, linear ? Exact{1} << q_.weight_bits : 1}};
    std::vector<Neighbour> along_r{{0, 1}};
    if (volume_) along_r = along(q_.coordinate[2], q_.sampler.wrap_r, image.depth, linear);
    std::array<std::vector<Exact>, 4> layers;
    for (const Neighbour& r : along_r) {
      layer_ = r.index;
      for (const Neighbour& t : along_t) {
        for (const Neighbour& s : along_s) add(image, s.index, t.index, weight * s.weight * t.weight * r.weight);
      }
      if (!q_.rounds_each || r.weight == 0) continue;
      for (std::size_t k = 0; k < 4; ++k) layers[k].push_back(blended_layer(k, image, along_s, along_t));
    }
    if (q_.rounds_each) {
      for (std::size_t k = 0; k < 4; ++k) {
        level_code_[levels_][k] =
            layers[k].size() == 2 ? mixed(layers[k][0], layers[k][1], along_r[1].weight) : layers[k][0];
      }
      ++levels_;
    }
    answer_.level = level;
    shift_ = weight_shift + (linear ? (volume_ ? 3 : 2) * q_.weight_bits : 0);
  }

  // The measured filters of the NV2A: L(a, b, w) = (a (2^bits - w) + b w) / 2^bits to nearest, of u, then of v.
  Exact mixed(Exact a, Exact b, Exact weight) const {
    const Exact steps = Exact{1} << q_.weight_bits;
    return floor_divide(2 * (a * (steps - weight) + b * weight) + steps, 2 * steps);
  }

  Exact blended_layer(std::size_t k, const TextureImage& image, const std::vector<Neighbour>& along_s,
                      const std::vector<Neighbour>& along_t) const {
    std::vector<Exact> rows;
    for (const Neighbour& t : along_t) {
      if (t.weight == 0) continue;
      std::vector<Exact> codes;
      Exact second = 0;
      for (const Neighbour& s : along_s) {
        if (s.weight == 0) continue;
        codes.push_back(code_of(k, is_outside(image, s.index, t.index), image, s.index, t.index));
        second = s.weight;
      }
      rows.push_back(codes.size() == 2 ? mixed(codes[0], codes[1], second) : codes[0]);
    }
    return rows.size() == 2 ? mixed(rows[0], rows[1], along_t[1].weight) : rows[0];
  }

  bool is_outside(const TextureImage& image, int x, int y) const {
    return x < 0 || y < 0 || layer_ < 0 || x >= image.width || y >= image.height || layer_ >= image.depth;
  }

  void add(const TextureImage& image, int x, int y, Exact weight) {
    if (weight == 0) return;
    const bool border = is_outside(image, x, y);
    answer_.border = answer_.border || border;
    for (std::size_t k = 0; k < 4; ++k) {
      if (const auto* half = std::get_if<std::array<Plane<const Half>, 4>>(&image.planes)) {
        add_real(k, border ? border_real(k) : half_value((*half)[k].at(x, row(image, y)).bits), weight);
      } else if (const auto* real = std::get_if<std::array<Plane<const float>, 4>>(&image.planes)) {
        add_real(k, border ? border_real(k) : static_cast<long double>((*real)[k].at(x, row(image, y))), weight);
      } else {
        add_code(k, border, image, x, y, weight);
      }
    }
  }

  long double border_real(std::size_t k) const {
    const float value = q_.sampler.border_color[k];
    return value > 1 ? 1 : value > 0 ? value : 0;
  }

  void add_real(std::size_t k, long double value, Exact weight) {
    answer_.real[k] += static_cast<long double>(weight) * value;
    answer_.magnitude[k] += static_cast<long double>(weight) * std::fabs(value);
  }

  void add_code(std::size_t k, bool border, const TextureImage& image, int x, int y, Exact weight) {
    sum_[k] += weight * code_of(k, border, image, x, y);
  }

  int row(const TextureImage& image, int y) const { return layer_ * image.height + y; }

  // Two's complement where the component is signed. Words of 16 bits are codes of alpha and of green.
  Exact code_of(std::size_t k, bool border, const TextureImage& image, int x, int y) const {
    if (!words_) return number(plain_code(k, border, image, x, y), 256, is_signed_[k]);
    if (k == 0 || k == 2) return 0;
    const Exact low = plain_code(k == 3 ? 0 : 2, border, image, x, y);
    return number(256 * plain_code(k, border, image, x, y) + low, 65536, is_signed_[k]);
  }
  static Exact number(Exact code, Exact range, bool is_signed) {
    return is_signed && code >= range / 2 ? code - range : code;
  }

  // 0 for a component that is not stored, and for floats.
  Exact plain_code(std::size_t k, bool border, const TextureImage& image, int x, int y) const {
    std::uint32_t code = to_code(q_.sampler.border_color[k], largest_);
    if (!border) {
      if (const auto* bytes = std::get_if<std::array<Plane<const std::uint8_t>, 4>>(&image.planes)) {
        if (!(*bytes)[k]) return 0;
        code = (*bytes)[k].at(x, row(image, y));
      } else if (const auto* codes = std::get_if<std::array<Plane<const std::uint32_t>, 4>>(&image.planes)) {
        if (!(*codes)[k]) return 0;
        code = (*codes)[k].at(x, row(image, y));
      } else {
        return 0;
      }
    }
    if (compares()) {
      const std::uint32_t reference = to_code(q_.coordinate[2], largest_);
      code = passes(reference, code) ? 255 : 0;
    }
    return code;
  }

  // Measured on the NV2A, where r is a whole number: r FUNC stored code, all eight functions.
  bool passes(std::uint32_t r, std::uint32_t stored) const {
    switch (q_.sampler.comparison) {
      case DepthComparison::never:
        return false;
      case DepthComparison::less:
        return r < stored;
      case DepthComparison::equal:
        return r == stored;
      case DepthComparison::lequal:
        return r <= stored;
      case DepthComparison::greater:
        return r > stored;
      case DepthComparison::notequal:
        return r != stored;
      case DepthComparison::gequal:
        return r >= stored;
      case DepthComparison::none:
      case DepthComparison::always:
        return true;
    }
    std::abort();
  }

  bool compares() const { return depth_ && q_.sampler.comparison != DepthComparison::none; }

  TextureAnswer finish() {
    const Exact whole = Exact{1} << shift_;
    for (std::size_t k = 0; k < 4; ++k) {
      Exact filtered = floor_divide(2 * sum_[k] + whole, 2 * whole);
      if (q_.rounds_each) {
        const Exact one_level = level_code_[0][k];
        filtered = levels_ == 2 ? mixed(one_level, level_code_[1][k], second_) : one_level;
      }
      answer_.code[k] = static_cast<std::uint32_t>(filtered);
      if (is_signed_[k] && !words_) answer_.code[k] &= 0xFF;
      answer_.real[k] /= static_cast<long double>(whole);
      answer_.magnitude[k] /= static_cast<long double>(whole);
      Exact byte = answer_.code[k];
      if (depth_ && !compares()) byte = (2 * 255 * byte + largest_) / (2 * Exact{largest_});
      answer_.value[k] = static_cast<std::uint8_t>(byte);
    }
    if (words_) {
      for (const std::size_t k : {1U, 3U}) {
        answer_.value[k] = static_cast<std::uint8_t>((answer_.code[k] >> 8) & 0xFF);
        answer_.value[k == 3 ? 0 : 2] = static_cast<std::uint8_t>(answer_.code[k] & 0xFF);
      }
    }
    if (texture_.format == InternalFormat::rgb8) answer_.value[3] = 255;
    if (equals_key()) {
      answer_.killed = q_.sampler.color_key.operation == ColorKeyOperation::kill;
      if (q_.sampler.color_key.operation == ColorKeyOperation::rgba) answer_.value = {};
      if (q_.sampler.color_key.operation == ColorKeyOperation::alpha) answer_.value[3] = 0;
    }
    return answer_;
  }

  // All bits of the texel's word, 0xAARRGGBB, or those of its colour where the format has no alpha.
  bool equals_key() const {
    std::uint32_t word = texture_.format == InternalFormat::rgb8 ? 0 : answer_.value[3];
    for (std::size_t k = 0; k < 3; ++k) word = 256 * word + answer_.value[k];
    return word == q_.sampler.color_key.key % (texture_.format == InternalFormat::rgb8 ? 1ULL << 24 : 1ULL << 32);
  }

  const TextureQuestion& q_;
  const Texture& texture_;
  int lambda_;
  bool cube_ = false;
  bool depth_ = false;
  bool volume_ = false;
  bool words_ = false;
  int layer_ = 0;
  std::array<bool, 4> is_signed_{};
  std::uint32_t largest_ = 255;
  std::size_t face_ = 0;
  std::array<float, 2> place_{};
  std::array<Exact, 4> sum_{};
  int shift_ = 0;
  std::array<std::array<Exact, 4>, 2> level_code_{};  // of the levels that were read, where each blend is rounded
  std::size_t levels_ = 0;
  Exact second_ = 0;  // the weight of the second level
  TextureAnswer answer_;
};

bool complete(const Texture& texture, bool mipmaps) {
  const std::size_t faces = texture.target == TextureTarget::cube_map ? 6 : 1;
  for (std::size_t face = 0; face < faces; ++face) {
    const auto& levels = texture.faces[face];
    if (levels.empty() || texture.faces[0].empty()) return false;
    if (mipmaps && texture.target == TextureTarget::rectangle) return false;
    if (levels[0].width != texture.faces[0][0].width || levels[0].height != texture.faces[0][0].height) return false;
    if (!mipmaps) continue;
    for (std::size_t level = 1; level < levels.size(); ++level) {
      const TextureImage &finer = levels[level - 1], &image = levels[level];
      if (image.width != (finer.width == 1 ? 1 : finer.width / 2)) return false;
      if (image.height != (finer.height == 1 ? 1 : finer.height / 2)) return false;
      if (image.depth != (finer.depth == 1 ? 1 : finer.depth / 2)) return false;
    }
    if (levels.back().width != 1 || levels.back().height != 1 || levels.back().depth != 1) return false;
  }
  return true;
}

// The square of the larger of the two changes, in texels of level 0.
double rho_squared(const TextureQuestion& q) {
  const TextureImage& base = q.texture->faces[0][0];
  double largest = 0;
  for (const auto& change : {q.dx, q.dy}) {
    double u = static_cast<double>(change[0]), v = static_cast<double>(change[1]);
    if (q.texture->target == TextureTarget::cube_map) {
      const Direction d = face_of(q.coordinate);
      u = face_change(d, 0, q.coordinate, change);
      v = face_change(d, 1, q.coordinate, change);
    }
    double w = 0;
    if (q.texture->target == TextureTarget::texture_3d) w = static_cast<double>(change[2]) * base.depth;
    if (q.texture->target != TextureTarget::rectangle) {
      u *= base.width;
      v *= base.height;
    }
    const double square = u * u + v * v + w * w;
    if (square > largest) largest = square;
  }
  return largest;
}

}  // namespace

std::vector<TextureAnswer> sample(const TextureQuestion& question) {
  const MinFilter min = question.sampler.min_filter;
  if (!complete(*question.texture, min != MinFilter::nearest && min != MinFilter::linear)) return {};
  float bias = question.sampler.lod_bias;
  if (std::isnan(bias)) bias = 0;
  bias = bias > 15 ? 15 : bias < -15 ? -15 : bias;
  const long double exact = static_cast<long double>(bias) * 256;
  const auto bias_256 = static_cast<int>(question.cuts_bias ? exact : std::floor(exact + 0.5L));
  std::vector<TextureAnswer> answers;
  for (const int lambda : levels_of_detail(rho_squared(question))) {
    answers.push_back(Model(question, lambda + bias_256).answer());
  }
  return answers;
}

}  // namespace ninebit::oracle
