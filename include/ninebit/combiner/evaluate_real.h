// One fragment in real numbers: what the equations of NV_register_combiners say, step by step, without any narrowing.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/program.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Red, green, blue, alpha in real numbers, 1.0 being full.
using RealColor = std::array<double, 4>;

// Every register's components in real numbers.
struct RealRegisters {
  std::array<RealColor, kRegisterCount> value{};                                    // by Register
  RealColor& operator[](Register r) { return value[static_cast<std::size_t>(r)]; }  // one of the first kRegisterCount
  const RealColor& operator[](Register r) const { return value[static_cast<std::size_t>(r)]; }  // likewise
};

// One of the three outputs of a portion, in one channel.
struct RealOutput {
  double wide = 0;     // AB, CD: the product or dot product; third: their sum or the mux's choice
  double scaled = 0;   // (wide + bias) · scale; 0 for an output that is discarded
  double written = 0;  // that, clamped to [-1, 1]: what the register gets; 0 for an output that is discarded
};

// A portion in one channel.
struct RealChannel {
  std::array<double, 4> input{};  // A to D as the products see them: fetched and mapped
  RealOutput ab, cd, third;       // third.wide is 0 if the third output is discarded
};

// A general combiner: its products and outputs, and the registers behind it.
struct RealStage {
  bool takes_cd = false;             // whether a mux takes CD: spare0's alpha, as it enters the stage, is at least 1/2
                                     // or, by the lowest bit, its nearest code is odd
  std::array<RealChannel, 3> rgb{};  // all 0 if the RGB portion writes nothing
  RealChannel alpha{};               // likewise
  RealRegisters after;               // the registers with the stage's outputs
  RegisterFile codes;                // their nearest codes, decided like RealEvaluation::codes
};

// The final combiner: its inputs, mapped, and what it makes of them.
struct RealFinal {
  std::array<RealColor, 6> input{};  // A to F, mapped; no alpha
  double g = 0;                      // mapped
  RealColor e_times_f{};             // no alpha
  RealColor color_sum{};             // spare0 + secondary, inverted and clamped where the program says so; no alpha
  RealColor unclamped{};             // A·B + (1 - A)·C + D, and G
};

// A fragment's way through a program, in real numbers.
struct RealEvaluation {
  RealRegisters before;          // what the codes stand for; zero and the constants are not read, and stay
  std::vector<RealStage> stage;  // one for each general combiner
  RealFinal final_combiner;      // what makes the colour
  RealColor color{};             // clamped to [0, 1]

  // The nearest codes, halves up, decided by the real numbers themselves and not by the doubles that report them.
  EvaluatedFragment codes;

  // The registers after the last general combiner.
  [[nodiscard]] const RealRegisters& registers() const { return stage.empty() ? before : stage.back().after; }
};

// Runs a program over one fragment in real numbers, whatever the program's own arithmetic. Registers and constants
// start as code / program.datapath.one.
//
// `exact`: all numbers are exact, choices of the mux included; only the doubles above are rounded, each to nearest.
// `float32`: 32-bit floats, each operation rounded, in the order in which the equations are written: dot products
// (r + g) + b, outputs (wide - 1/2) · scale, the final combiner (A·B + (1 - A)·C) + D. `integer` counts as exact.
//
// Beside an integer trace, give the very program and registers of that trace and Arithmetic::exact.
[[nodiscard]] RealEvaluation evaluate_real(const Program& program, const RegisterFile& initial,
                                           Arithmetic arithmetic = Arithmetic::exact);

}  // namespace ninebit
