// Heat maps of the datapath's operations with two inputs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/study/datapath_error.h"
#include "src/study/datapath/datapath_report.h"
#include "src/study/datapath/operations.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

// A map over the codes `first` to one: x to the right, y upward. Its colours range from -span to span, where span is
// the largest absolute value.
HeatMap map_of(int first, int one, const std::function<double(int x, int y)>& value) {
  HeatMap map;
  map.width = map.height = one - first + 1;
  map.x_first = map.y_last = first;
  map.x_last = map.y_first = one;
  const auto size = static_cast<std::size_t>(map.width);
  map.values.resize(size * size);
  parallel_for(size, [&](std::size_t row) {
    for (int column = 0; column < map.width; ++column) {
      map.values[row * size + static_cast<std::size_t>(column)] =
          static_cast<float>(value(first + column, one - static_cast<int>(row)));
    }
  });
  float span = 0.0F;
  for (const float v : map.values) span = std::max(span, std::fabs(v));
  map.low = -span;
  map.high = span;
  return map;
}

// A form as part of a file name: "x4", "x1by2", "biased-x2".
std::string file_part(const OutputForm& form) {
  const char* scale = form.scale == Scale::none      ? "x1"
                      : form.scale == Scale::by_two  ? "x2"
                      : form.scale == Scale::by_four ? "x4"
                                                     : "x1by2";
  return std::string(form.bias == Bias::none ? "" : "biased-") + scale;
}

int output_code(const Datapath& d, const OutputForm& form, int wide) {
  return reference::combiner_output(d, form.scale, form.bias, wide);
}

// The error in codes: 1 is a register's last bit. Rounding of doubles counts as 0.
double error_in_codes(int code, double exact, int one) {
  const double error = code - exact * one;
  return std::fabs(error) < 1e-9 ? 0.0 : error;
}

// An operation of two codes x and y, given by its wide value: A · B or, with B = D = 1, A + C.
struct TwoInputs {
  const char* name;
  const char* file;
  const char* x_label;
  const char* y_label;
  int (*wide)(int one, int x, int y);
};
constexpr std::array kTwoInputs{
    TwoInputs{"A · B", "product", "A, as code", "B, as code", [](int, int x, int y) { return x * y; }},
    TwoInputs{"A + C", "sum", "A, as code", "C, as code", [](int one, int x, int y) { return (x + y) * one; }}};

class Maps {
 public:
  void add_errors(const HardwareProfile& profile) {
    const Datapath d = datapath_of(profile);
    const double square = static_cast<double>(d.one) * d.one;
    for (const TwoInputs& operation : kTwoInputs) {
      for (const OutputForm& form : kOutputForms) {
        HeatMap map = map_of(-d.one, d.one, [&](int x, int y) {
          const int wide = operation.wide(d.one, x, y);
          return error_in_codes(output_code(d, form, wide), exact_output(form, wide / square), d.one);
        });
        add(std::move(map), fmt::format("{}-{}-{}", operation.file, file_part(form), profile.name),
            fmt::format("Error of {}, {}, on {}", operation.name, form.name, profile.name), operation);
      }
    }
    HeatMap map = map_of(
        0, d.one, [&](int x, int y) { return error_in_codes(reference::e_times_f(d, x, y), x * y / square, d.one); });
    add(std::move(map), fmt::format("e-times-f-{}", profile.name), fmt::format("Error of E · F on {}", profile.name),
        {"", "", "E, as code", "F, as code", nullptr});
  }

  void add_differences(const HardwareProfile& first, const HardwareProfile& second) {
    const Datapath a = datapath_of(first), b = datapath_of(second);
    // Products without a scale, and with the scale of the article's program.
    for (const OutputForm& form : {kOutputForms[0], kOutputForms[2]}) {
      HeatMap map = map_of(-a.one, a.one,
                           [&](int x, int y) { return output_code(b, form, x * y) - output_code(a, form, x * y); });
      add(std::move(map), fmt::format("product-{}-{}-minus-{}", file_part(form), second.name, first.name),
          fmt::format("A · B, {}: {} minus {}", form.name, second.name, first.name), kTwoInputs[0]);
    }
  }

  [[nodiscard]] std::vector<HeatMap> take() { return std::move(maps_); }

 private:
  void add(HeatMap map, std::string file, std::string title, const TwoInputs& operation) {
    if (map.high == 0.0F) return;
    map.file = std::move(file);
    map.title = std::move(title);
    map.x_label = operation.x_label;
    map.y_label = operation.y_label;
    map.caption = "In codes: 1 is a register's last bit. One pixel per case.";
    maps_.push_back(std::move(map));
  }

  std::vector<HeatMap> maps_;
};

}  // namespace

std::vector<HeatMap> datapath_maps(std::span<const HardwareProfile> profiles) {
  Maps maps;
  const auto known =
      std::find_if(profiles.begin(), profiles.end(), [](const auto& p) { return p.name == profiles::geforce2.name; });
  maps.add_errors(known != profiles.end() ? *known : profiles.front());
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    for (std::size_t k = i + 1; k < profiles.size(); ++k) {
      if (profiles[i].one.value == profiles[k].one.value) maps.add_differences(profiles[i], profiles[k]);
    }
  }
  return maps.take();
}

}  // namespace ninebit
