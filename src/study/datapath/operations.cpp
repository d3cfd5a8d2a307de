#include "src/study/datapath/operations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ninebit/combiner/evaluate.h"
#include "src/study/digits/digits.h"

namespace ninebit {
namespace {

std::uint64_t once(std::size_t) {
  return 1;
}

double clamped(double v, double low, double high) {
  return std::clamp(v, low, high);
}

double exact_mapping(InputMapping mapping, double e) {
  const double positive = std::max(e, 0.0);
  switch (mapping) {
    case InputMapping::unsigned_identity:
      return positive;
    case InputMapping::unsigned_invert:
      return 1.0 - std::min(positive, 1.0);
    case InputMapping::expand_normal:
      return 2.0 * positive - 1.0;
    case InputMapping::expand_negate:
      return 1.0 - 2.0 * positive;
    case InputMapping::half_bias_normal:
      return positive - 0.5;
    case InputMapping::half_bias_negate:
      return 0.5 - positive;
    case InputMapping::signed_identity:
      return e;
    case InputMapping::signed_negate:
      return -e;
  }
  return e;
}

constexpr const char* kFinalLerpForm = "A B + (1 - A) C + D";

const char* color_sum_form(bool clamp) {
  return clamp ? "clamped" : "not clamped";
}

// Collects the forms of one operation.
class Forms {
 public:
  Forms(std::string_view name, int one) : name_(name), one_(one), codes_(static_cast<std::size_t>(2 * one + 1)) {}

  void mappings() {
    for (const InputMapping mapping : kInputMappings) {
      add(
          std::string(name_of(mapping)), codes_, once,
          [this_one = one_, mapping](const Datapath& d, std::size_t i) {
            return reference::map_input(d, mapping, static_cast<int>(i) - this_one);
          },
          [o = one_, mapping](std::size_t i) { return exact_mapping(mapping, real(static_cast<int>(i) - o, o)); },
          [o = one_](std::size_t i) { return fmt::format("{}", static_cast<int>(i) - o); });
    }
  }

  // Products of 1 with a register: the effect of scale and bias alone.
  void scales_and_biases() {
    for (const OutputForm& form : kOutputForms) {
      add(
          std::string(form.name), codes_, once,
          [o = one_, form](const Datapath& d, std::size_t i) {
            return reference::combiner_output(d, form.scale, form.bias, (static_cast<int>(i) - o) * d.one);
          },
          [o = one_, form](std::size_t i) { return exact_output(form, real(static_cast<int>(i) - o, o)); },
          [o = one_](std::size_t i) { return fmt::format("{}", static_cast<int>(i) - o); });
    }
  }

  // Outputs whose wide value is a sum of `terms` products.
  void sums(std::size_t terms, const std::shared_ptr<const WideCounts>& counts) {
    // Most numbers are not sums of products: only the wide values that occur are cases.
    const auto wides = std::make_shared<std::vector<int>>();
    for (int w = -counts->limit; w <= counts->limit; ++w) {
      if (counts->of(w) != 0) wides->push_back(w);
    }
    for (const OutputForm& form : kOutputForms) {
      add(
          std::string(form.name), wides->size(), [counts, wides](std::size_t i) { return counts->of((*wides)[i]); },
          [wides, form](const Datapath& d, std::size_t i) {
            return reference::combiner_output(d, form.scale, form.bias, (*wides)[i]);
          },
          [wides, form, o = one_](std::size_t i) {
            return exact_output(form, static_cast<double>((*wides)[i]) / (static_cast<double>(o) * o));
          },
          [wides, o = one_, terms](std::size_t i) { return products_of((*wides)[i], o, terms); });
    }
  }

  void mux() {
    add(
        "", codes_, once,
        [o = one_](const Datapath& d, std::size_t i) {
          return reference::mux(d, false, static_cast<int>(i) - o, 0, d.one);
        },
        [o = one_](std::size_t i) { return 2 * (static_cast<int>(i) - o) >= o ? 1.0 : 0.0; },
        [o = one_](std::size_t i) { return fmt::format("spare0.a {}", static_cast<int>(i) - o); });
  }

  void color_sum() {
    const std::size_t n = codes_;
    for (const bool clamp : {true, false}) {
      add(
          color_sum_form(clamp), n * n, once,
          [o = one_, n, clamp](const Datapath& d, std::size_t i) {
            return reference::color_sum(d, clamp, static_cast<int>(i / n) - o, static_cast<int>(i % n) - o);
          },
          [o = one_, n, clamp](std::size_t i) {
            const double sum = std::max(real(static_cast<int>(i / n) - o, o), 0.0) +
                               std::max(real(static_cast<int>(i % n) - o, o), 0.0);
            return clamp ? std::min(sum, 1.0) : sum;
          },
          [o = one_, n](std::size_t i) {
            return fmt::format("{} + {}", static_cast<int>(i / n) - o, static_cast<int>(i % n) - o);
          });
    }
  }

  void e_times_f() {
    const std::size_t n = static_cast<std::size_t>(one_) + 1;
    add(
        "", n * n, once,
        [n](const Datapath& d, std::size_t i) {
          return reference::e_times_f(d, static_cast<int>(i / n), static_cast<int>(i % n));
        },
        [o = one_, n](std::size_t i) { return real(static_cast<int>(i / n), o) * real(static_cast<int>(i % n), o); },
        [n](std::size_t i) { return fmt::format("{} * {}", i / n, i % n); });
  }

  // A·B + (1 - A)·C + D: one case for each value of A·B + (1 - A)·C that occurs, and each D.
  void final_lerp() {
    struct Mix {
      std::uint64_t count = 0;
      int a = 0, b = 0, c = 0;
    };
    const std::size_t n = static_cast<std::size_t>(one_) + 1;
    std::vector<Mix> by_value(static_cast<std::size_t>(one_ * one_ + 1));
    for (int a = 0; a <= one_; ++a) {
      for (int b = 0; b <= one_; ++b) {
        for (int c = 0; c <= one_; ++c) {
          Mix& mix = by_value[static_cast<std::size_t>(a * b + (one_ - a) * c)];
          if (mix.count++ == 0) mix = {1, a, b, c};
        }
      }
    }
    const auto mixes = std::make_shared<std::vector<Mix>>();
    for (const Mix& mix : by_value) {
      if (mix.count != 0) mixes->push_back(mix);
    }
    add(
        kFinalLerpForm, mixes->size() * n, [mixes, n](std::size_t i) { return (*mixes)[i / n].count; },
        [mixes, n](const Datapath& d, std::size_t i) {
          const Mix& m = (*mixes)[i / n];
          return reference::final_rgb(d, m.a, m.b, m.c, static_cast<int>(i % n));
        },
        [mixes, n, o = one_](std::size_t i) {
          const Mix& m = (*mixes)[i / n];
          const double mix = static_cast<double>(m.a * m.b + (o - m.a) * m.c) / (static_cast<double>(o) * o);
          return clamped(mix + real(static_cast<int>(i % n), o), 0.0, 1.0);
        },
        [mixes, n](std::size_t i) {
          const Mix& m = (*mixes)[i / n];
          return fmt::format("A {}, B {}, C {}, D {}", m.a, m.b, m.c, i % n);
        });
  }

  [[nodiscard]] std::vector<DatapathOperation> take() { return std::move(all_); }

 private:
  static double real(int code, int one) { return static_cast<double>(code) / one; }

  void add(std::string form, std::size_t cases, std::function<std::uint64_t(std::size_t)> weight,
           std::function<int(const Datapath&, std::size_t)> code, std::function<double(std::size_t)> exact,
           std::function<std::string(std::size_t)> inputs) {
    all_.push_back(
        {name_, std::move(form), cases, std::move(weight), std::move(code), std::move(exact), std::move(inputs)});
  }

  // `terms` products of codes from -one to one whose sum is `wide`, chosen greedily with the largest product first.
  static std::string products_of(int wide, int one, std::size_t terms) {
    if (terms == 1) {
      const int size = std::abs(wide), sign = wide < 0 ? -1 : 1;
      for (int a = 1; a <= one; ++a) {
        if (size % a == 0 && size / a <= one) return fmt::format("{} * {}", sign * (size / a), a);
      }
      return wide == 0 ? "0 * 0" : "";
    }
    // Finds a product close to `wide` such that the other terms can reach the rest.
    const int reach = one * one * static_cast<int>(terms - 1);
    for (int a = one; a >= 0; --a) {
      for (int b = one; b >= -one; --b) {
        const int rest = wide - (wide < 0 ? -a * b : a * b);
        if (std::abs(rest) > reach) continue;
        const std::string others = products_of(rest, one, terms - 1);
        if (!others.empty()) return fmt::format("{} * {} + {}", wide < 0 ? -a : a, b, others);
      }
    }
    return {};
  }

  std::string_view name_;
  int one_;
  std::size_t codes_;
  std::vector<DatapathOperation> all_;
};

}  // namespace

double exact_output(const OutputForm& form, double value) {
  const double scale = form.scale == Scale::by_two        ? 2.0
                       : form.scale == Scale::by_four     ? 4.0
                       : form.scale == Scale::by_one_half ? 0.5
                                                          : 1.0;
  return clamped((value - (form.bias == Bias::none ? 0.0 : 0.5)) * scale, -1.0, 1.0);
}

// Counts for sums of `terms` products. Each is computed from the counts for one term less, which are kept too.
const std::shared_ptr<const WideCounts>& Operations::counts(std::size_t terms) {
  const std::size_t i = terms - 1;
  std::call_once(counted_[i], [&] {
    counts_[i] = std::make_shared<const WideCounts>(terms == 1 ? product_counts(one_)
                                                               : sum_counts(*counts(terms - 1), *counts(1)));
  });
  return counts_[i];
}

std::vector<std::string> forms_of(std::size_t kind) {
  std::vector<std::string> names;
  switch (kind) {
    case 0:
      for (const InputMapping mapping : kInputMappings) names.emplace_back(name_of(mapping));
      return names;
    case 1:
    case 2:
    case 3:
    case 4:
      for (const OutputForm& form : kOutputForms) names.emplace_back(form.name);
      return names;
    case 6:
      return {color_sum_form(true), color_sum_form(false)};
    case 8:
      return {kFinalLerpForm};
    default:
      return {""};
  }
}

const std::vector<DatapathOperation>& Operations::of(std::size_t kind) {
  std::call_once(made_[kind], [&] {
    Forms forms(kOperations[kind], one_);
    switch (kind) {
      case 0:
        forms.mappings();
        break;
      case 1:
        forms.scales_and_biases();
        break;
      case 2:
      case 3:
      case 4:
        forms.sums(kind - 1, counts(kind - 1));
        break;
      case 5:
        forms.mux();
        break;
      case 6:
        forms.color_sum();
        break;
      case 7:
        forms.e_times_f();
        break;
      default:
        forms.final_lerp();
    }
    operations_[kind] = forms.take();
  });
  return operations_[kind];
}

}  // namespace ninebit
