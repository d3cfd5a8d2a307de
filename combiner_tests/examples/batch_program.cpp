#include <gtest/gtest.h>
#include <ninebit/combiner/batch_program.h>
#include <ninebit/combiner/normalize.h>
#include <ninebit/numerics/hardware_profile.h>

TEST(Examples, BatchProgram) {
  using namespace ninebit;
  const BatchProgram batch(normalize(CombinerState{}, profiles::geforce2));
  EXPECT_TRUE(batch.reads().contains(Register::primary, kRed));
  RegisterBatch registers{};
  for (std::size_t i = 0; i < kBatchSize; ++i) {
    registers(Register::primary, kRed)[i] = static_cast<s9>(i % 256);
    registers(Register::fog, kAlpha)[i] = 255;
  }
  OutputBatch out{};
  batch.run(registers, kBatchSize, out);
  EXPECT_EQ(out.plane[kRed][77], 77);
}
