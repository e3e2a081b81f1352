"""The one vector operation behind the small dense kernels.

LLVM does not vectorise loops as short as the eight rows of the film, so the operation that all of
them consist of is written out on vectors of eight, in LLVM's own vector type: portable, and free
of any assumption on the processor.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

LANES = 8
_FUSED = ("contract",)


def padded(count: int) -> int:
    """Smallest multiple of the vector length that holds `count` numbers."""
    return LANES * -(-count // LANES)


@intrinsic
def add_rows(
    typing_context: Any, y: Any, at: Any, x: Any, x_at: Any, x_step: Any, a: Any, a_at: Any, a_step: Any,
    count: Any,
) -> tuple[Any, Callable[..., Any]]:
    """y[at:at+8] += sum over j < count of x[x_at + j x_step] a[a_at + j a_step : ... + 8].

    `y`, `x` and `a` are one-dimensional contiguous float64 arrays; nothing is checked.
    """
    signature = types.void(y, types.intp, x, types.intp, types.intp, a, types.intp, types.intp, types.intp)

    def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        double = ir.DoubleType()
        vector = ir.VectorType(double, LANES)
        y_, at_, x_, x_at_, x_step_, a_, a_at_, a_step_, count_ = args
        data = [
            context.make_array(kind)(context, builder, value).data
            for kind, value in ((sig.args[0], y_), (sig.args[2], x_), (sig.args[5], a_))
        ]

        def row(base: Any, index: Any) -> Any:
            return builder.bitcast(builder.gep(base, [index]), vector.as_pointer())

        target = row(data[0], at_)
        total = cgutils.alloca_once_value(builder, builder.load(target, align=8))
        mask = ir.Constant(ir.VectorType(ir.IntType(32), LANES), None)
        undefined = ir.Constant(vector, ir.Undefined)
        with cgutils.for_range(builder, count_) as loop:
            factor = builder.load(
                builder.gep(data[1], [builder.add(x_at_, builder.mul(loop.index, x_step_))])
            )
            single = builder.insert_element(undefined, factor, ir.Constant(ir.IntType(32), 0))
            splat = builder.shuffle_vector(single, undefined, mask)
            values = builder.load(
                row(data[2], builder.add(a_at_, builder.mul(loop.index, a_step_))), align=8
            )
            product = builder.fmul(splat, values, flags=_FUSED)
            builder.store(builder.fadd(builder.load(total), product, flags=_FUSED), total)
        builder.store(builder.load(total), target, align=8)
        return context.get_dummy_value()

    return signature, generate
