#include "program.hpp"

int main(int argc, char** argv) {
  turnscan::cli::Program program;
  program.add_reference();
  return program.run(argc, argv);
}
