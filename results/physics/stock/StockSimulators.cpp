#include "results/physics/stock/StockSimulators.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "base/Error.h"
#include "physics/DecouplingSimulator.h"
#include "results/physics/stock/StockWorld.h"

namespace heft {

namespace {
// Faster than any hand or cube; a diverging coupling passes these within a few steps.
constexpr double impossible_speed_m_s = 100, impossible_turn_rad_s = 1e4;

class StockSimulator : public DecouplingSimulator {
 public:
  StockSimulator(std::string name, MakeStockCoupling make_coupling)
      : name_(std::move(name)), make_coupling_(make_coupling) {}

  void reset(const Scene& scene, const Pose& target) override {
    // Stock Bullet multiplies the coefficients of two bodies.
    for (const Cube& cube : scene.cubes)
      if (cube.table_friction)
        throw OutsideModel(name_ + " does not model cubes with their own friction on the table");
    coupling_.reset();
    world_.emplace(scene, clone_start(scene, target));
    if (scene.coupling.decoupled) coupling_ = make_coupling_(*world_, scene.coupling);
    target_ = target;
    t_s_ = 0;
  }

  void step(const Pose& target, double h_s) override {
    refuse_impossible();  // Bullet's trees require finite positions
    if (coupling_) {
      coupling_->step(*world_, {target_, target, h_s});
    } else {
      world_->clone().setCenterOfMassTransform(to_bullet(target));
      world_->step(h_s);
    }
    target_ = target;
    t_s_ += h_s;
    refuse_impossible();
  }

  void teleport_clone(const Pose& target, const Velocity& velocity) override {
    world_->put_clone(target, velocity);
    target_ = target;
  }

  void set_clone_solid(bool solid) override { world_->set_clone_solid(solid); }
  void place_cube(int cube, const Pose& pose) override {
    world_->put_cube(static_cast<std::size_t>(cube), pose);
  }
  WorldState state() const override { return world_->state(); }

 private:
  void refuse_impossible() const {
    if (world_->slower_than(impossible_speed_m_s, impossible_turn_rad_s)) return;
    throw Error(
        fmt::format("{} became unstable {:.4g} s after its start; choose another simulator (boxes, "
                    "bullet) or a "
                    "higher rate, see results/physics/README.md",
                    name_, t_s_));
  }

  std::string name_;
  MakeStockCoupling make_coupling_;
  std::optional<StockWorld> world_;
  std::unique_ptr<StockCoupling> coupling_;  ///< none in condition C1; goes before its world
  Pose target_;
  double t_s_ = 0;
};

struct StockSetup {
  std::string_view name;
  MakeStockCoupling couple;
};

constexpr std::array table{
    StockSetup{"bullet-explicit", explicit_force},
    StockSetup{"bullet-explicit-held", held_force},
    StockSetup{"bullet-stable-pd", stable_pd},
    StockSetup{"bullet-exact-velocity", exact_velocity},
    StockSetup{"bullet-soft-rows", soft_rows},
    StockSetup{"bullet-spring2", six_dof_spring},
};

template <std::size_t row>
std::unique_ptr<DecouplingSimulator> make() {
  return std::make_unique<StockSimulator>(std::string(table[row].name), table[row].couple);
}

template <std::size_t... rows>
MakeSimulator found(std::string_view name, std::index_sequence<rows...>) {
  MakeSimulator maker = nullptr;
  ((table[rows].name == name ? void(maker = make<rows>) : void()), ...);
  return maker;
}
}  // namespace

MakeSimulator stock_simulator(std::string_view name) {
  return found(name, std::make_index_sequence<table.size()>());
}

}  // namespace heft
