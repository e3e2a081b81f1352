"""The vector operations behind the small dense kernels.

LLVM does not vectorise loops as short as the eight rows of the film, so the two operations that all
of them consist of are written out on vectors of eight, in LLVM's own vector type: portable, and free
of any assumption on the processor.  Arrays are one-dimensional, contiguous float64; nothing is checked.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite import ir  # type: ignore[import-untyped]
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

LANES = 8
_FUSED = ("contract",)
_VECTOR = ir.VectorType(ir.DoubleType(), LANES)
_SPLAT = ir.Constant(ir.VectorType(ir.IntType(32), LANES), None)
_FIRST = ir.Constant(ir.IntType(32), 0)


def padded(count: int) -> int:
    """Smallest multiple of the vector length that holds `count` numbers."""
    return LANES * -(-count // LANES)


def _data(context: Any, builder: Any, kind: Any, value: Any) -> Any:
    return context.make_array(kind)(context, builder, value).data


def _row(builder: Any, data: Any, index: Any) -> Any:
    return builder.bitcast(builder.gep(data, [index]), _VECTOR.as_pointer())


def _sum_of_rows(keep: bool, sign: int) -> Any:
    """Make y[at:at+8] (+)= sign * sum over j < count of x[x_at + j x_step] a[a_at + j a_step : ... + 8]."""

    def operation(
        typing_context: Any, y: Any, at: Any, x: Any, x_at: Any, x_step: Any, a: Any, a_at: Any, a_step: Any,
        count: Any,
    ) -> tuple[Any, Callable[..., Any]]:  # fmt: skip
        index = types.intp
        signature = types.void(y, index, x, index, index, a, index, index, index)

        def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            y_, at_, x_, x_at_, x_step_, a_, a_at_, a_step_, count_ = args
            target = _row(builder, _data(context, builder, sig.args[0], y_), at_)
            factors = _data(context, builder, sig.args[2], x_)
            rows = _data(context, builder, sig.args[5], a_)
            first = builder.load(target, align=8) if keep else ir.Constant(_VECTOR, None)
            total = cgutils.alloca_once_value(builder, first)
            undefined = ir.Constant(_VECTOR, ir.Undefined)
            with cgutils.for_range(builder, count_) as loop:
                place = builder.add(x_at_, builder.mul(loop.index, x_step_))
                factor = builder.load(builder.gep(factors, [place]))
                single = builder.insert_element(undefined, factor, _FIRST)
                splat = builder.shuffle_vector(single, undefined, _SPLAT)
                place = builder.add(a_at_, builder.mul(loop.index, a_step_))
                product = builder.fmul(splat, builder.load(_row(builder, rows, place), align=8), flags=_FUSED)
                combine = builder.fadd if sign > 0 else builder.fsub
                builder.store(combine(builder.load(total), product, flags=_FUSED), total)
            builder.store(builder.load(total), target, align=8)
            return context.get_dummy_value()

        return signature, generate

    return operation


set_rows: Any = intrinsic(_sum_of_rows(keep=False, sign=1))
add_rows: Any = intrinsic(_sum_of_rows(keep=True, sign=1))
subtract_rows: Any = intrinsic(_sum_of_rows(keep=True, sign=-1))


def _product(sign: int) -> Any:
    """Make y[at:at+8] += sign * a[a_at : a_at + 8] * b[b_at : b_at + 8]."""

    def operation(
        typing_context: Any, y: Any, at: Any, a: Any, a_at: Any, b: Any, b_at: Any
    ) -> tuple[Any, Callable[..., Any]]:
        signature = types.void(y, types.intp, a, types.intp, b, types.intp)

        def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            target, left, right = (
                _row(builder, _data(context, builder, sig.args[k], args[k]), args[k + 1]) for k in (0, 2, 4)
            )
            product = builder.fmul(builder.load(left, align=8), builder.load(right, align=8), flags=_FUSED)
            combine = builder.fadd if sign > 0 else builder.fsub
            builder.store(combine(builder.load(target, align=8), product, flags=_FUSED), target, align=8)
            return context.get_dummy_value()

        return signature, generate

    return operation


add_product: Any = intrinsic(_product(1))
subtract_product: Any = intrinsic(_product(-1))
