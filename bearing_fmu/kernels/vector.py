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
TILE = 8  #: rows whose sums are made at once
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


def _tile_of_rows(keep: bool, sign: int) -> Any:
    """As `_sum_of_rows`, for TILE rows of y and x at once, which lie `y_next` and `x_next` apart.

    Their sums do not wait for one another, and share what is read of a.  What is kept of y is taken
    times eight numbers of `part`.
    """

    def operation(
        typing_context: Any, y: Any, at: Any, y_next: Any, part: Any, part_at: Any, x: Any, x_at: Any,
        x_step: Any, x_next: Any, a: Any, a_at: Any, a_step: Any, count: Any,
    ) -> tuple[Any, Callable[..., Any]]:  # fmt: skip
        index = types.intp
        signature = types.void(y, index, index, part, index, x, index, index, index, a, index, index, index)

        def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            y_, at_, y_next_, part_, part_at_, x_, x_at_, x_step_, x_next_, a_, a_at_, a_step_, count_ = args
            data = _data(context, builder, sig.args[0], y_)
            factors = _data(context, builder, sig.args[5], x_)
            rows = _data(context, builder, sig.args[9], a_)
            number = [ir.Constant(x_step_.type, r) for r in range(TILE)]
            target = [_row(builder, data, builder.add(at_, builder.mul(r, y_next_))) for r in number]
            first = [ir.Constant(_VECTOR, None)] * TILE
            if keep:
                share = builder.load(
                    _row(builder, _data(context, builder, sig.args[3], part_), part_at_), align=8
                )
                first = [builder.fmul(builder.load(t, align=8), share) for t in target]
            totals = [cgutils.alloca_once_value(builder, value) for value in first]
            undefined = ir.Constant(_VECTOR, ir.Undefined)
            combine = builder.fadd if sign > 0 else builder.fsub
            with cgutils.for_range(builder, count_) as loop:
                place = builder.add(a_at_, builder.mul(loop.index, a_step_))
                row = builder.load(_row(builder, rows, place), align=8)
                place = builder.add(x_at_, builder.mul(loop.index, x_step_))
                for r, total in zip(number, totals, strict=True):
                    factor = builder.load(builder.gep(factors, [builder.add(place, builder.mul(r, x_next_))]))
                    single = builder.insert_element(undefined, factor, _FIRST)
                    splat = builder.shuffle_vector(single, undefined, _SPLAT)
                    product = builder.fmul(splat, row, flags=_FUSED)
                    builder.store(combine(builder.load(total), product, flags=_FUSED), total)
            for place, total in zip(target, totals, strict=True):
                builder.store(builder.load(total), place, align=8)
            return context.get_dummy_value()

        return signature, generate

    return operation


set_tile: Any = intrinsic(_tile_of_rows(keep=False, sign=1))
subtract_tile: Any = intrinsic(_tile_of_rows(keep=True, sign=-1))


def _product(keep: bool, sign: int) -> Any:
    """Make y[at:at+8] (+)= sign * a[a_at : a_at + 8] * b[b_at : b_at + 8]."""

    def operation(
        typing_context: Any, y: Any, at: Any, a: Any, a_at: Any, b: Any, b_at: Any
    ) -> tuple[Any, Callable[..., Any]]:
        signature = types.void(y, types.intp, a, types.intp, b, types.intp)

        def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            target, left, right = (
                _row(builder, _data(context, builder, sig.args[k], args[k]), args[k + 1]) for k in (0, 2, 4)
            )
            product = builder.fmul(builder.load(left, align=8), builder.load(right, align=8), flags=_FUSED)
            if keep:
                combine = builder.fadd if sign > 0 else builder.fsub
                product = combine(builder.load(target, align=8), product, flags=_FUSED)
            builder.store(product, target, align=8)
            return context.get_dummy_value()

        return signature, generate

    return operation


set_product: Any = intrinsic(_product(keep=False, sign=1))
add_product: Any = intrinsic(_product(keep=True, sign=1))
subtract_product: Any = intrinsic(_product(keep=True, sign=-1))
