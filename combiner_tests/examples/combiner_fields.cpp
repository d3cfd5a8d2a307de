#include <gtest/gtest.h>
#include <ninebit/numerics/hardware_profile.h>
#include <ninebit/study/combiner_fields.h>

TEST(Examples, CombinerFields) {
  using namespace ninebit;
  for (const CombinerField& field : arithmetic_fields(profiles::nv2a)) {
    HardwareProfile rival = profiles::nv2a;
    if (field.is_open()) field.values.back().set(rival);
    EXPECT_GE(field.values.size(), 1U) << field.name;
  }
  EXPECT_FALSE(register_fields(profiles::geforce2).empty());
}
