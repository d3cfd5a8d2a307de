#include "ninebit/study/datapath_error.h"

#include <oneapi/tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "src/study/operations.h"

namespace ninebit {
namespace {

OperationError measure(const HardwareProfile& profile, const Operation& operation) {
  OperationError out;
  out.profile = profile.name;
  out.operation = operation.name;
  out.form = operation.form;
  const Datapath d = datapath_of(profile);
  std::set<int> codes;
  int last = 0;
  double sum = 0.0, sum_of_sizes = 0.0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < operation.cases; ++i) {
    const std::uint64_t weight = operation.weight(i);
    const int code = operation.code(d, i);
    if (i == 0 || code != last) codes.insert(code);
    last = code;
    const double error = static_cast<double>(code) / d.one - operation.exact(i);
    // What is exact in real numbers may differ by the last bit of a double.
    const double size = std::fabs(error) < 1e-12 ? 0.0 : std::fabs(error);
    out.cases += weight;
    if (size == 0.0) out.exact += weight;
    sum_of_sizes += static_cast<double>(weight) * size;
    if (size != 0.0) sum += static_cast<double>(weight) * error;
    // A larger one by more than rounding.
    if (size > out.max_error + 1e-12) {
      out.max_error = size;
      worst = i;
    }
  }
  out.distinct = codes.size();
  out.mean_error = sum_of_sizes / static_cast<double>(out.cases);
  out.mean_bias = sum / static_cast<double>(out.cases);
  out.worst = operation.inputs(worst);
  out.worst_code = operation.code(d, worst);
  out.worst_exact = operation.exact(worst);
  return out;
}

OperationDifference compare(const HardwareProfile& first, const HardwareProfile& second, const Operation& operation) {
  OperationDifference out{std::string(first.name), std::string(second.name), operation.name, operation.form, 0, 0};
  const Datapath a = datapath_of(first), b = datapath_of(second);
  for (std::size_t i = 0; i < operation.cases; ++i) {
    const std::uint64_t weight = operation.weight(i);
    out.cases += weight;
    if (operation.code(a, i) != operation.code(b, i)) out.differ += weight;
  }
  return out;
}

}  // namespace

Result<DatapathErrors> measure_datapath(std::span<const HardwareProfile> profiles,
                                        const std::function<bool(double done)>& progress) {
  std::map<int, std::vector<Operation>> operations;  // by `one`
  std::vector<const HardwareProfile*> measured;
  for (const HardwareProfile& profile : profiles) {
    if (profile.arithmetic != Arithmetic::integer) continue;
    measured.push_back(&profile);
    if (operations.count(profile.one) == 0) operations[profile.one] = datapath_operations(profile.one);
  }

  // Every piece of work has a place of its own for its result, so that threads change nothing.
  struct Work {
    const HardwareProfile* first;
    const HardwareProfile* second;  // nullptr: errors of the first
    const Operation* operation;
    OperationError error{};
    OperationDifference difference{};
  };
  std::vector<Work> work;
  for (const HardwareProfile* profile : measured) {
    for (const Operation& operation : operations[profile->one]) work.push_back({profile, nullptr, &operation});
  }
  for (std::size_t i = 0; i < measured.size(); ++i) {
    for (std::size_t k = i + 1; k < measured.size(); ++k) {
      if (measured[i]->one != measured[k]->one) continue;
      for (const Operation& operation : operations[measured[i]->one]) {
        work.push_back({measured[i], measured[k], &operation});
      }
    }
  }
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> stopped = false;
  std::mutex asking;
  tbb::parallel_for(std::size_t{0}, work.size(), [&](std::size_t i) {
    if (stopped) return;
    Work& w = work[i];
    if (w.second == nullptr) {
      w.error = measure(*w.first, *w.operation);
    } else {
      w.difference = compare(*w.first, *w.second, *w.operation);
    }
    const double share = static_cast<double>(++done) / static_cast<double>(work.size());
    if (!progress) return;
    const std::scoped_lock lock(asking);
    if (!progress(share)) stopped = true;
  });
  if (stopped) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  DatapathErrors out;
  for (Work& w : work) {
    if (w.second == nullptr) {
      out.errors.push_back(std::move(w.error));
    } else {
      out.differences.push_back(std::move(w.difference));
    }
  }
  return out;
}

}  // namespace ninebit
