// The smallest program with Weir: a dam breaks for one second, then a few numbers.
#include <stdio.h>
#include <weir/weir.h>

int main(void)
{
    WeirScene *scene = weir_scene_create();
    weir_scene_set_domain(scene, (double[3]){0, 0}, (double[3]){2, 1});
    weir_scene_add_box(scene, (double[3]){0, 0}, (double[3]){0.5, 0.8}, NULL);
    WeirSim *sim = weir_sim_create(scene, NULL);
    while (weir_sim_status(sim) == WEIR_OK && weir_sim_time(sim) < 1.0) weir_sim_step(sim, 100);

    WeirDiagnostics now;
    WeirStatus status = weir_sim_diagnose(sim, WEIR_DIAGNOSE_NEIGHBORS, &now);
    if (status == WEIR_OK) status = weir_sim_status(sim);
    printf("%s\n%u particles, %.3f s, %.1f J in motion, density error %.2f %%\n", weir_sim_device(sim),
           weir_sim_particle_count(sim), weir_sim_time(sim), now.kinetic_energy,
           100.0 * now.density_error_mean);
    if (status != WEIR_OK) printf("stopped: %s\n", weir_sim_error(sim));
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
    return status;
}
