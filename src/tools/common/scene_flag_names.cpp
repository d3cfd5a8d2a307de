// The names of enumerators in flags and in JSON.
#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {

const Names<IndexFormat> kIndexFormats{{"rgb", IndexFormat::rgb},
                                       {"la", IndexFormat::luminance_alpha},
                                       {"l", IndexFormat::luminance},
                                       {"a", IndexFormat::alpha}};
const Names<IndexScope> kIndexScopes{
    {"polygon", IndexScope::polygon}, {"object", IndexScope::object}, {"section", IndexScope::section}};
const Names<IndexOrder> kIndexOrders{{"file", IndexOrder::file}, {"neighbour", IndexOrder::neighbour}};
const Names<IndexScales> kIndexScales{{"both-x4", IndexScales::both},
                                      {"first-x4", IndexScales::first},
                                      {"second-x4", IndexScales::second},
                                      {"no-scale", IndexScales::none}};
const Names<DepthCubeBits> kDepthBits{
    {"8", DepthCubeBits::eight}, {"16", DepthCubeBits::sixteen}, {"float", DepthCubeBits::real}};
const Names<DepthEncoding> kDepthEncodings{{"d24", DepthEncoding::d24},
                                           {"d16", DepthEncoding::d16},
                                           {"rgba8-fract", DepthEncoding::rgba8_fract},
                                           {"rgba8-mod", DepthEncoding::rgba8_mod},
                                           {"rgba8-256over255", DepthEncoding::rgba8_256over255},
                                           {"rgba8-modf", DepthEncoding::rgba8_modf}};

}  // namespace ninebit::tools
