#include "anthrob_sim/effects/effect.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {

EnergyAudit audit_energy(const Simulation& sim) {
  const RobotModel& model = sim.model();
  const std::vector<BodyState>& bodies = sim.bodies();
  EnergyAudit audit{0.0, 0.0};
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const BodyModel& body = model.skeleton->bodies[i];
    const Vec3 w_B = bodies[i].X_WB.R.transpose() * bodies[i].w_W;
    audit.kinetic += 0.5 * body.mass * bodies[i].v_W.squaredNorm() +
                     0.5 * w_B.dot(body.principal.cwiseProduct(w_B));
    audit.potential -= body.mass * model.gravity.dot(bodies[i].X_WB.p);
  }
  for (const auto& torque : model.joint_torques) {
    audit.potential += torque->energy(sim.configuration());
  }
  audit.potential += sim.presliding_energy();
  return audit;
}

}  // namespace anthrob
