#pragma once
#include <turnscan/workflow/progress/overall_progress.hpp>
