// What every pass may read. The C side puts the two structs, made from params.inl and constants.inl, before this.
@group(0) @binding(0) var<uniform> parameters: Parameters;
@group(0) @binding(1) var<uniform> constants: Constants;
