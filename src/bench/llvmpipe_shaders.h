// The rival's passes in GLSL 3.30.
#pragma once

namespace ninebit::bench::shaders {

inline constexpr const char* kHeader = "#version 330 core\n";

// All camera passes compute the position in the same way, so that the depth test EQUAL finds exactly equal depths.
inline constexpr const char* kCameraPosition =
    "layout(location = 0) in vec3 position;\n"
    "uniform mat4 projection;\n"
    "invariant gl_Position;\n";

inline constexpr const char* kMapVertex =
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec4 index;\n"
    "uniform mat4 projection;\n"
    "uniform vec3 light;\n"
    "flat out vec4 own;\n"
    "void main() { gl_Position = projection * vec4(position - light, 1.0); own = index; }\n";
inline constexpr const char* kMapFragment =
    "flat in vec4 own;\n"
    "layout(location = 0) out vec4 color;\n"
    "void main() { color = own; }\n";

inline constexpr const char* kDepthVertex = "void main() { gl_Position = projection * vec4(position, 1.0); }\n";
inline constexpr const char* kDepthFragment = "void main() {}\n";

inline constexpr const char* kCompareVertex =
    "layout(location = 1) in uvec4 index;\n"
    "uniform vec3 light;\n"
    "flat out uvec3 own;\n"
    "out vec3 from_light;\n"
    "void main() { gl_Position = projection * vec4(position, 1.0); own = index.rgb; from_light = position - light; }\n";
inline constexpr const char* kCompareFragment =
    "flat in uvec3 own;\n"
    "in vec3 from_light;\n"
    "uniform samplerCube map;\n"
    "void main() { if (uvec3(texture(map, from_light).rgb * 255.0 + 0.5) == own) discard; }\n";

inline constexpr const char* kShadeVertex =
    "layout(location = 1) in vec4 shade;\n"
    "out vec4 smooth_shade;\n"
    "void main() { gl_Position = projection * vec4(position, 1.0); smooth_shade = shade; }\n";
inline constexpr const char* kShadeFragment =
    "in vec4 smooth_shade;\n"
    "layout(location = 0) out vec4 color;\n"
    "void main() { color = smooth_shade; }\n";

}  // namespace ninebit::bench::shaders
