// Units of keys. Private to the layer model/.
#pragma once
#include "model/keys.h"

namespace whine::units {

inline constexpr Unit kNone{"", "1"}, kDegree{"_deg", "rad", std::numbers::pi, 180, "°"},
    kCornerDegree{"", "rad", std::numbers::pi, 180}, kMillimetre{"_mm", "m", 1, 1000},
    kMicrometre{"_um", "m", 1, 1e6, "µm"}, kInertia{"_kgm2", "kg m2", 1, 1, "kg m²"}, kKilogram{"_kg", "kg"},
    kNewtonMetre{"_Nm", "N m", 1, 1, "N m"}, kNewtonPerMicrometre{"_N_um", "N m-1", 1e6, 1, "N/µm"},
    kGigapascal{"_GPa", "Pa", 1e9}, kDensity{"_kgm3", "kg m-3", 1, 1, "kg/m³"},
    kNewtonPerSquareMillimetre{"_N_mm2", "N m-2", 1e6, 1, "N/mm²"}, kPerSecond{"_per_s", "s-1", 1, 1, "1/s"},
    kSecond{"_s", "s"}, kHertzUnit{"_Hz", "Hz"}, kKilohertz{"_kHz", "Hz", 1000},
    kNewtonSecondPerMetre{"_Ns_m", "N s m-1", 1, 1, "N s/m"},
    kMillipascalSecond{"_mPas", "Pa s", 1, 1000, "mPa s"}, kPercentUnit{"_percent", "1", 1, 100, "%"};

}  // namespace whine::units
