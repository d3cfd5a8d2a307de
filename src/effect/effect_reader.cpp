#include "src/effect/effect_reader.h"

#include <charconv>
#include <cmath>

#include "src/effect/moving_number.h"

namespace ninebit::effect_detail {

using json::Type;
using json::Value;

void EffectReader::text(const Value& value, std::string& into) {
  if (value.type != Type::string) return read_.wrong_type(value, "a string");
  into = value.text;
}

void EffectReader::check_file(const Value& value, const std::string& name) {
  if (!check_ || name.empty()) return;
  if (const auto why = check_(name)) read_.fault(value.offset, *why);
}

void EffectReader::real(const Value& value, double lowest, double highest, float& into, Numbers numbers) {
  const auto shown = [](double shown_number) {
    std::array<char, 32> digits{};
    const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), shown_number);
    return std::string(digits.data(), written.ptr);
  };
  double number = 0.0;
  bool is_number = false;
  std::string found = " is out of range";
  if (value.type == Type::string && numbers == Numbers::moving) {
    const auto moving = moving_number(value.text, moment_);
    if (!moving) return read_.fault(value.offset, json::in_quotes(value.text) + ' ' + moving.error().message);
    number = moving->value;
    is_number = true;
    moves_ = moves_ || moving->moves;
    found = " is " + shown(number) + " at time " + shown(moment_.time) + ", frame " + std::to_string(moment_.frame);
  } else if (value.type == Type::number) {
    const char* const end = value.text.data() + value.text.size();
    const auto [stop, error] = std::from_chars(value.text.data(), end, number);
    is_number = stop == end && (error == std::errc{} || error == std::errc::result_out_of_range);
  } else {
    return read_.wrong_type(value,
                            numbers == Numbers::moving ? "a number, or a string with an expression" : "a number");
  }
  if (!is_number || !std::isfinite(number) || number < lowest || number > highest) {
    return read_.fault(value.offset, json::in_quotes(value.text) + found + "; expected a number from " + shown(lowest) +
                                         " to " + shown(highest));
  }
  into = static_cast<float>(number);
}

std::size_t EffectReader::reals(const Value& value, std::size_t fewest, double lowest, double highest,
                                std::span<float> into, Numbers numbers) {
  const std::size_t count = value.children.size();
  if (value.type != Type::array || count < fewest || count > into.size()) {
    const std::string expected = fewest == into.size()
                                     ? std::to_string(fewest) + " numbers"
                                     : std::to_string(fewest) + " to " + std::to_string(into.size()) + " numbers";
    read_.fault(value.offset, (value.key.empty() ? "the value" : value.key) + " must be an array of " + expected);
    return 0;
  }
  for (std::size_t i = 0; i < count; ++i) real(value.children[i], lowest, highest, into[i], numbers);
  return count;
}

void EffectReader::point(const Value& value, std::optional<glm::vec3>& into) {
  std::array<float, 3> n{};
  if (reals(value, 3, -1e12, 1e12, n, Numbers::moving) != 0) into = glm::vec3(n[0], n[1], n[2]);
}

void EffectReader::bytes(const Value& value, std::span<std::uint8_t> into) {
  std::array<float, 4> n{};
  const std::span<float> numbers = std::span<float>(n).first(into.size());
  if (reals(value, into.size(), 0.0, 1.0, numbers) == 0) return;
  for (std::size_t i = 0; i < into.size(); ++i) {
    into[i] = static_cast<std::uint8_t>(std::floor(static_cast<double>(n[i]) * 255.0 + 0.5));
  }
}

void EffectReader::byte(const Value& value, std::uint8_t& into) {
  int number = into;
  read_.integer(value, 0, 255, number);
  into = static_cast<std::uint8_t>(number);
}

}  // namespace ninebit::effect_detail
