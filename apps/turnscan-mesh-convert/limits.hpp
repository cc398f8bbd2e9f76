#pragma once

/// Limits memory, processor time, file size and core dumps of this process, and lets it end
/// together with the one that started it. Sanitizers need more address space than any limit:
/// under them, memory is not limited.
void limit_this_process();
