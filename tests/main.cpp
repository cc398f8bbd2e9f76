#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>
#include <iostream>
#include <locale>

// What other libraries leave behind is not ours to release: glibc's newlocale keeps a copy of
// LOCPATH, lib3mf 1.8 never closes the parts of an archive that it opens through libzip, and OpenNI
// 2 and the drivers it loads keep what they made when they were loaded.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:argz_add_sep\nleak:libzip.so\nleak:libOpenNI2.so\nleak:/OpenNI2/Drivers/\n";
}

// Every test runs in a locale that writes 1.234,5 for 1234.5: whatever reads or writes numbers by
// the locale shows at once.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
#ifdef TURNSCAN_TEST_LOCPATH
  setenv("LOCPATH", TURNSCAN_TEST_LOCPATH, 1);
  const char* const name = "de_DE.UTF-8";
  if (std::setlocale(LC_NUMERIC, name) == nullptr) {
    std::cerr << "no locale " << name << " in " << TURNSCAN_TEST_LOCPATH << '\n';
    return 1;
  }
  std::locale::global(std::locale(std::locale::classic(), name, std::locale::numeric));
#endif
  return RUN_ALL_TESTS();
}
