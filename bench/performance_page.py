"""Writes the rows of one run of scripts/bench into the tables of docs/research/performance.md.

A table of the page stands between `<!-- bench NAME -->` and `<!-- end -->`. All are written again: one
of which the run has no rows says so, so that no figure is older than the revision that the page names.
"""
import re

BLOCK = re.compile(r'(<!-- bench (\S+) -->\n).*?(<!-- end -->)', re.S)


def table(header, rows):
    lines = [header, ['---'] * len(header), *rows]
    return '\n'.join('| ' + ' | '.join(map(str, line)) + ' |' for line in lines) + '\n'


def spread(figures, kind):
    return f'{figures[kind + "_median"]:.3f} ({figures[kind + "_p95"]:.2f})'


def f_scores(figures):
    return ' / '.join(f'{f:.3f}' for f in figures['f'].values())


# What is said of each whole process, where it is known.
FIGURES = {
    'seconds': lambda r: f'{r["wall"]:.1f}',
    'seconds of processor': lambda r: f'{r["cpu"]:.1f}',
    'peak memory, MB': lambda r: f'{r["peak_mb"]:.0f}',
    'watertight': lambda r: 'yes' if r['closed'] else 'no',
    'accuracy, median (p95), mm': lambda r: spread(r['seen'], 'accuracy'),
    'completeness, median (p95), mm': lambda r: spread(r['seen'], 'completeness'),
    'F at 0.5 / 1 / 2 mm, of what was seen': lambda r: f_scores(r['seen']),
    'F at 0.5 / 1 / 2 mm, of all': lambda r: f_scores(r['all']),
}


def programs(rows):
    """A column for each program."""
    lines = []
    for name, figure in FIGURES.items():
        cells = []
        for row in rows:
            try:
                cells.append(figure(row))
            except KeyError:
                cells.append('failed' if 'failed' in row else '')
        if any(cells):
            lines.append([name, *cells])
    return table(['', *(row['program'] for row in rows)], lines)


def steps(rows):
    out = ''
    for row in rows:
        stages = ', '.join(f'{k} {v:.2f}' for k, v in row['stages'].items() if v >= 0.005)
        out += (f'{row["case"]}: {row["wall"]:.1f} s, {row["cpu"]:.1f} s of processor, '
                f'{row["peak_mb"]:.0f} MB. Seconds of the report: {stages}.\n\n')
        counts = row.get('instructions', {})
        if counts:
            out += table(['step, with one thread', '10^9 instructions', '%'],
                         [[step.replace('  ', '&ensp;', 1), f'{count / 1e9:.2f}',
                           f'{100 * count / counts["all"]:.1f}']
                          for step, count in counts.items()]) + '\n'
    return out


def volume(rows):
    return table(['', 'times the wall time', 'times the processor time'],
                 [[r['program'], f'{r["times_wall"]:.1f}', f'{r["times_cpu"]:.1f}'] for r in rows])


def kernels(rows):
    return table(['step', 'million items a second', 'GB a second'],
                 [[r['program'], f'{r["items_per_s"] / 1e6:.3g}', f'{r["bytes_per_s"] / 1e9:.2g}']
                  for r in rows])


def outliers(rows):
    frames = dict.fromkeys(r['frame'] for r in rows)
    lines = []
    for frame in frames:
        by = {r['program']: r['ns_per_point'] for r in rows if r['frame'] == frame}
        lines.append([frame, *(f'{by[way]:.0f}' for way in ('pcl', 'one thread', 'all cores')),
                      f'{by["pcl"] / by["one thread"]:.1f} times'])
    return table(['frame', "PCL's StatisticalOutlierRemoval", 'turnscan, one thread', 'all cores',
                  'one thread against PCL'], lines)


def samples(rows):
    ways = list(dict.fromkeys(r['program'] for r in rows))
    scenes = dict.fromkeys((r['scene'], r['triangles']) for r in rows)
    return table(['scene', 'triangles', *ways], [
        [scene, f'{count / 1000:.0f} k',
         *(f'{next(r["ms"] for r in rows if (r["scene"], r["triangles"], r["program"]) == (scene, count, way)):.3g}'
           for way in ways)] for scene, count in scenes])


WRITERS = {'doll': programs, 'table61': programs, 'python': programs, 'steps': steps,
           'volume': volume, 'kernels': kernels, 'outliers': outliers, 'samples': samples}


def fill(page, run):
    """The page with the tables of this run: {'machine', 'revision', 'command', 'rows'}."""
    def block(match):
        name = match[2]
        if name == 'run':
            text = ('Revision {revision}; {processor}, {cores} cores, load {load:.1f} before it; '.format(
                **run, **run['machine']) + f'`{run["command"]}`.\n')
        else:
            rows = [r for r in run['rows'] if r.get('suite') == name]
            text = WRITERS[name](rows) if rows else 'Not measured in this run.\n'
        return f'{match[1]}\n{text.rstrip()}\n\n{match[3]}'
    return BLOCK.sub(block, page)
