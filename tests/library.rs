//! Tests of the library through its public interface; one program, so that it is linked once and all tests share the
//! cores.

mod common;

#[path = "library/adhesion.rs"]
mod adhesion;
#[path = "library/cases_refused.rs"]
mod cases_refused;
#[cfg(feature = "cli")]
#[path = "library/checked_states.rs"]
mod checked_states;
#[path = "library/creep.rs"]
mod creep;
#[path = "library/detachments.rs"]
mod detachments;
#[path = "library/energy.rs"]
mod energy;
#[path = "library/fatigue.rs"]
mod fatigue;
#[path = "library/first_touch.rs"]
mod first_touch;
#[path = "library/fretting.rs"]
mod fretting;
#[path = "library/fretting_wear.rs"]
mod fretting_wear;
#[path = "library/given_load.rs"]
mod given_load;
#[path = "library/hardness.rs"]
mod hardness;
#[path = "library/heat.rs"]
mod heat;
#[path = "library/identification.rs"]
mod identification;
#[path = "library/indenters.rs"]
mod indenters;
#[path = "library/instruments.rs"]
mod instruments;
#[path = "library/interface_friction.rs"]
mod interface_friction;
#[path = "library/invariance.rs"]
mod invariance;
#[path = "library/isolated.rs"]
mod isolated;
#[path = "library/largest_stresses.rs"]
mod largest_stresses;
#[path = "library/life.rs"]
mod life;
#[path = "library/limit_paths.rs"]
mod limit_paths;
#[path = "library/limits.rs"]
mod limits;
#[path = "library/lines.rs"]
mod lines;
#[path = "library/moving.rs"]
mod moving;
#[path = "library/operator.rs"]
mod operator;
#[path = "library/rigid_base.rs"]
mod rigid_base;
#[path = "library/rings.rs"]
mod rings;
#[path = "library/roughness.rs"]
mod roughness;
#[path = "library/run.rs"]
mod run;
#[path = "library/sliding.rs"]
mod sliding;
#[path = "library/sliding_edges.rs"]
mod sliding_edges;
#[path = "library/sliding_stress.rs"]
mod sliding_stress;
#[path = "library/solver.rs"]
mod solver;
#[path = "library/stated_errors.rs"]
mod stated_errors;
#[path = "library/stopping.rs"]
mod stopping;
#[path = "library/strains.rs"]
mod strains;
#[path = "library/stress.rs"]
mod stress;
#[path = "library/surface_stress.rs"]
mod surface_stress;
#[path = "library/surroundings.rs"]
mod surroundings;
#[path = "library/tangent.rs"]
mod tangent;
#[path = "library/topographies.rs"]
mod topographies;
#[path = "library/two_bodies.rs"]
mod two_bodies;
#[path = "library/unloading.rs"]
mod unloading;
#[path = "library/volume.rs"]
mod volume;
#[path = "library/wear.rs"]
mod wear;
#[path = "library/work.rs"]
mod work;
