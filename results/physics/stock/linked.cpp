// Linked into heft-bench and its tests, and into no library: what makes the simulators that the
// table in physics only names. A program's table is so fixed when it is linked.
#include "results/physics/stock/StockSimulators.h"

namespace heft {

MakeSimulator linked_simulator(std::string_view name) {
  return stock_simulator(name);
}

}  // namespace heft
