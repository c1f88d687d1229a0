// What the stages of a pair warn of and remark, as HTML: what is said at several torques is said once.
#pragma once
#include "report/report_content.h"

namespace whine {

std::string remarks_list(const ReportContent& c);

}  // namespace whine
