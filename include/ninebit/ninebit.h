// Everything of ninebit.
#pragma once

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/image/image_io.h"
#include "ninebit/image/staged_files.h"
#include "ninebit/language/gl_nv.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/index_cube.h"
#include "ninebit/shadow/pictures.h"
#include "ninebit/shadow/technique.h"
