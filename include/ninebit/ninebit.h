/* Everything: to C the C interface; to C++ the whole library but its JSON forms (language/json.h,
   language/profile_json.h, language/trace_json.h). C++ that wants the C interface includes capi/combiner.h and links
   with ninebit_capi. */
#pragma once

#ifndef __cplusplus
#include "ninebit/capi/combiner.h"
#else
#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/evaluate_real.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/trace.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/image/image_io.h"
#include "ninebit/image/staged_files.h"
#include "ninebit/image/texture_io.h"
#include "ninebit/language/c_source.h"
#include "ninebit/language/explain.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/gl_nv.h"
#include "ninebit/language/glsl.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_words.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/raster/prepared_draw.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/s3tc.h"
#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/depth_cube.h"
#include "ninebit/shadow/depth_packing.h"
#include "ninebit/shadow/ground_truth.h"
#include "ninebit/shadow/index_cube.h"
#include "ninebit/shadow/light_cookie.h"
#include "ninebit/shadow/pictures.h"
#include "ninebit/shadow/reflective.h"
#include "ninebit/shadow/shadow_map.h"
#include "ninebit/shadow/shadow_volume.h"
#include "ninebit/shadow/technique.h"
#endif
