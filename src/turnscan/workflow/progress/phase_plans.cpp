#include <turnscan/workflow/progress/phase_plans.hpp>
