// What nearly every source reads first, compiled once for all of them: Eigen alone costs a compiler three seconds.
// Sources include what they use all the same; `make lint` and the fuzzers compile them without this file.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>
#include "base/eigen_templates.h"
