// Whether the particles are sorted before the step under way; the passes that do it have nothing to do otherwise.
@group(0) @binding(BINDING_control) var<storage, read> control: Control;

fn is_sorting() -> bool {
    return control.clock.sorting == 1u && control.clock.running == 1u && is_well(control.bad_step, control.restored);
}
