// scan_reduce and scan_write of a method that sorts in every step.
fn is_sorting() -> bool {
    return true;
}
