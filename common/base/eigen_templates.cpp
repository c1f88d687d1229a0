// Compiled without the precompiled header, which declares them as extern.
#define WHINE_EIGEN_TEMPLATE template
#include "base/eigen_templates.h"
