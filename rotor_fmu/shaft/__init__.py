"""The unreduced shaft: elements, matrices, statics, fields."""
