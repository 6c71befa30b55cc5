#!/usr/bin/env python3
"""Learns the weights of a linear policy by the cross-entropy method: learn.py ENVIRONMENT.lua [--rounds N] [--seed N].

Each world tries weights of its own for one episode. The best eighth gives the mean and the spread of the next round.
It prints the weights of `linear_policy` as a parameter of the behaviour `learned_driver`."""

import argparse
import time

import numpy

import nezumi_env


def episodes(envs, weights, seed):
    """The sum of rewards of one episode in each world, whose actions are limited sums of weighted observations."""
    observations, _ = envs.reset(seed=seed)
    weights = weights.reshape(envs.num_envs, -1, observations.shape[1])
    totals, running = numpy.zeros(envs.num_envs), numpy.ones(envs.num_envs, bool)
    while running.any():
        actions = numpy.einsum("waf,wf->wa", weights, observations)
        observations, rewards, terminations, truncations, _ = envs.step(actions)
        totals += rewards * running
        running &= ~(terminations | truncations)
    return totals


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("environment")
    arguments.add_argument("--rounds", type=int, default=30)
    arguments.add_argument("--worlds", type=int, default=64)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--program", default="nezumi")
    options = arguments.parse_args()
    draws = numpy.random.default_rng(options.seed)
    began = time.monotonic()
    with nezumi_env.Vector(options.environment, options.worlds, program=options.program) as envs:
        size = envs.single_action_space.shape[0] * envs.single_observation_space.shape[0]
        mean, spread = numpy.zeros(size), numpy.ones(size)
        for round_ in range(options.rounds):
            tried = mean + spread * draws.standard_normal((options.worlds, size))
            tried[0] = mean
            totals = episodes(envs, tried, seed=options.seed + round_ * options.worlds)
            best = tried[numpy.argsort(totals)[-options.worlds // 8:]]
            mean, spread = best.mean(axis=0), best.std(axis=0) + 0.3 / (1 + round_)
            print("round %2d: best %7.2f, mean weights %7.2f, %5.1f s" %
                  (round_ + 1, totals.max(), totals[0], time.monotonic() - began), flush=True)
        final = episodes(envs, numpy.tile(mean, (options.worlds, 1)), seed=options.seed + options.rounds * options.worlds)
    print("%d episodes with the mean weights: median %.2f, worst %.2f" %
          (options.worlds, numpy.median(final), final.min()))
    print("weights = { %s }" % ", ".join("%.4f" % weight for weight in mean))


if __name__ == "__main__":
    main()
