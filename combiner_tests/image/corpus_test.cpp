// The fuzzer's corpus of DDS files, replayed without libFuzzer.
#include "combiner_tests/fuzz/corpus.h"

#include <gtest/gtest.h>

#include "ninebit/numerics/hardware_profile.h"
#include "src/image/texture/texture_file.h"

namespace ninebit::fuzz {
namespace {

TEST(Corpus, Dds) {
  replay("dds", check_dds, [](std::string_view bytes) {
    return image_detail::parse_dds(profiles::geforce2, "",
                                   {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()})
        .ok();
  });
}

}  // namespace
}  // namespace ninebit::fuzz
