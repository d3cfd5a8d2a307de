// How often random states had each value of each of their fields, and of each field of their profiles.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {

class Coverage {
 public:
  // A value of a field, and in how many places (stages for the fields of a portion, else states) it stood.
  struct Row {
    std::string field;
    std::string value;
    std::uint64_t seen = 0;
  };

  // Counts the stages that run, and in them the portions that write.
  void add(const CombinerState& state, const HardwareProfile& profile);

  // Every value that is legal with some shipped profile of this arithmetic has a row, seen or not.
  [[nodiscard]] std::vector<Row> rows(Arithmetic arithmetic) const;

  // The rows with so few places, one a line; empty if there is none.
  [[nodiscard]] static std::string rarer_than(std::uint64_t least, const std::vector<Row>& rows);
  // One field a line.
  [[nodiscard]] static std::string table(const std::vector<Row>& rows);

 private:
  struct Input {
    std::array<std::uint64_t, 16> reg{};
    std::array<std::uint64_t, 8> mapping{};
    std::array<std::uint64_t, 3> usage{};
    void add(const CombinerInput& in);
  };
  struct Writing {
    std::array<Input, 4> input{};
    std::array<std::array<std::uint64_t, 16>, 3> to{};
    std::array<std::array<std::uint64_t, 2>, 4> option{};
    std::array<std::array<std::uint64_t, 2>, 5> flag{};
    void add(const Portion& portion);
  };

  std::array<std::uint64_t, kMaxGeneralCombiners + 1> stages_{};
  std::array<std::uint64_t, 2> color_sum_clamp_{}, per_stage_constants_{}, mux_by_lowest_bit_{};
  std::array<std::uint64_t, 2> color_sum_invert_spare0_{}, color_sum_invert_secondary_{};
  Writing rgb_, alpha_;
  std::array<Input, 7> final_{};
  std::map<std::string, std::uint64_t, std::less<>> profiles_;
  // The fields of a profile that the arithmetic reads, by their distance from what geforce2 has.
  std::array<std::uint64_t, 2> lowest_{}, lowest_output_{}, half_{}, expand_offset_{}, general_narrowing_{},
      narrowing_point_{}, final_narrowing_{};
  std::array<std::uint64_t, 5> byte_shift_{};
};

}  // namespace ninebit::test
