// Linked into heft-bench and its tests, but into no library: overrides linked_simulator() of
// physics with the factories of the stock simulators.
#include "results/physics/stock/StockSimulators.h"

namespace heft {

MakeSimulator linked_simulator(std::string_view name) {
  return stock_simulator(name);
}

}  // namespace heft
