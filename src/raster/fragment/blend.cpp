#include "src/raster/fragment/blend.h"

#include "src/raster/rules/one_fragment.h"

namespace ninebit {

ColorBytes blend(const Blend& state, const ColorBytes& source, const ColorBytes& destination) {
  constexpr one_fragment::Numbers o{};
  ColorBytes result{};
  for (std::size_t k = 0; k < 4; ++k) {
    const one_fragment::BlendComponent<one_fragment::Numbers> c{.source = source[k],
                                                                .destination = destination[k],
                                                                .source_alpha = source[3],
                                                                .destination_alpha = destination[3],
                                                                .constant = state.color[k],
                                                                .constant_alpha = state.color[3],
                                                                .alpha_bits = k == 3 ? 255 : 0};
    result[k] = static_cast<std::uint8_t>(one_fragment::blended(o, state, c));
  }
  return result;
}

}  // namespace ninebit
