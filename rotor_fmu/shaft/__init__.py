"""The unreduced shaft: elements, matrices, statics, stress."""
