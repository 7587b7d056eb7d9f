#include "cli/program.h"

#include <unistd.h>

#include <iostream>

int main(int argc, char** argv) {
    return rawtexel::cli::run_program({argv + 1, argv + argc}, std::cout, std::cerr, isatty(STDERR_FILENO) != 0);
}
