// `make hard-cases` prints what each hard case expects and what the library finds; status 1 if one fails.
#include "hard_cases/table.h"

using namespace whine;

int main() {
  Table::head();
  for (const auto& cases : {known_answers(), numerical_stability()})
    for (const HardCase& one : cases) {
      Table table(one.id);
      try {
        one.run(table);
      } catch (const std::exception& e) {
        table.broken(e.what());
      }
    }
  std::printf("%d passed, %d failed\n", Table::passed, Table::failed);
  return Table::failed > 0;
}
