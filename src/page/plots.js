'use strict';
// Draws the plots of a page with dygraphs. Plots in one .plots box share the cursor and the time
// that is shown; the first view is the event: from 1 to 99 % of the variation of all lines.
{
    const style = getComputedStyle(document.documentElement);
    const colour = name => style.getPropertyValue(name).trim();
    const colours = [ 0, 1, 2, 3, 4, 5 ].map(i => colour('--c' + i));
    const span = values => {
        let low = Infinity, high = -Infinity;
        for (const v of values)
            if (v !== null) {
                low = Math.min(low, v);
                high = Math.max(high, v);
            }
        return high - low;
    };
    const eventOf = plots => {
        const steps = [];
        let low = Infinity, high = -Infinity, rows = 0;
        for (const {data} of plots) {
            rows = Math.max(rows, data.rows);
            low = Math.min(low, data.at[0]);
            high = Math.max(high, data.at[data.at.length - 1]);
            for (const s of data.series) {
                const whole = span(s.value);
                for (let i = 1; i < data.at.length && whole > 0; i++) {
                    const a = s.value[i - 1], b = s.value[i];
                    if (a !== null && b !== null && a !== b)
                        steps.push([ data.at[i], Math.abs(b - a) / whole ]);
                }
            }
        }
        steps.sort((a, b) => a[0] - b[0]);
        const total = steps.reduce((sum, s) => sum + s[1], 0);
        let sum = 0, first = low, last = high, begun = false;
        for (const [x, step] of steps) {
            sum += step;
            if (!begun && sum >= .01 * total) {
                first = x;
                begun = true;
            }
            if (sum >= .99 * total) {
                last = x;
                break;
            }
        }
        const least = 20 * (high - low) / rows;
        if (last - first < least) {
            const middle = (first + last) / 2;
            first = middle - least / 2;
            last = middle + least / 2;
        }
        const margin = .1 * (last - first);
        return {
            event : [ Math.max(low, first - margin), Math.min(high, last + margin) ],
            whole : [ low, high ]
        };
    };
    const rowsOf = data => data.at.map(
        (x, i) => [x, ...data.series.map(
                          s => s.value[i] === null ? null
                               : data.bars
                                   ? [ (s.low || s.value)[i], s.value[i], (s.high || s.value)[i] ]
                                   : s.value[i])]);
    const text = v => Math.abs(v) >= 1e5 || (v !== 0 && Math.abs(v) < 1e-4)
                          ? v.toExponential(3)
                          : String(+v.toPrecision(5));
    window.bolidePlots = [];
    for (const box of document.querySelectorAll('.plots')) {
        const plots = [...box.querySelectorAll('.plot') ].map(
            figure => ({figure, data : JSON.parse(figure.querySelector('script').textContent)}));
        if (!plots.length) continue;
        const times = eventOf(plots), over = plots.every(p => p.data.x === 'time');
        let view = over ? times.event : times.whole, busy = false;
        const all = action => {
            if (busy) return;
            busy = true;
            plots.forEach(action);
            busy = false;
        };
        const show = range => {
            view = range;
            all(p => p.graph.updateOptions({dateWindow : range}));
        };
        for (const plot of plots) {
            const {figure, data} = plot, many = data.series.length > 6;
            data.bars = data.series.some(s => s.low);
            const value =
                figure.querySelector('figcaption').appendChild(document.createElement('output'));
            value.className = 'value';
            const series = {};
            const labels = data.series.map(
                (s, i) =>
                    data.series.findIndex(o => o.name === s.name) < i ? s.name + ' ' + i : s.name);
            data.series.forEach((s, i) => {
                series[labels[i]] = s.dots ? {
                    strokeWidth : 0,
                    drawPoints : true,
                    pointSize : 2.5,
                    color : colour('--ink')
                }
                                    : s.dashed ? {strokePattern : [ 5, 4 ]}
                                               : {};
            });
            plot.graph = new Dygraph(figure.querySelector('.chart'), rowsOf(data), {
                labels : [ data.x, ...labels ],
                series,
                customBars : data.bars,
                fillAlpha : .18,
                colors : data.series.map(s => many ? colour('--faint') : colours[s.colour % 6]),
                dateWindow : view,
                legend : 'never',
                strokeWidth : 1.6,
                highlightCircleSize : 3,
                highlightSeriesOpts : many ? {strokeWidth : 2.5} : null,
                gridLineColor : colour('--line'),
                axisLineColor : colour('--faint'),
                xlabel : data.xunit ? data.x + ' (' + data.xunit + ')' : data.x,
                xRangePad : 0,
                yRangePad : 6,
                axes : {
                    y : {axisLabelWidth : 56, axisLabelFormatter : text, valueFormatter : text},
                    x : {axisLabelFormatter : text, valueFormatter : text}
                },
                highlightCallback : (event, x, points) => {
                    value.textContent =
                        text(x) + ' ' + data.xunit + ': ' +
                        points.map(p => (points.length > 1 ? p.name + ' ' : '') + text(p.yval))
                            .join(', ') +
                        ' ' + data.unit;
                    all(p => {
                        if (p !== plot) {
                            const row = p.data.at.findIndex(v => v >= x);
                            if (row >= 0) p.graph.setSelection(row);
                        }
                    });
                },
                unhighlightCallback : () => {
                    value.textContent = '';
                    all(p => {
                        if (p !== plot) p.graph.clearSelection();
                    });
                },
                zoomCallback : (low, high) => {
                    if (!busy) show([ low, high ]);
                },
            });
        }
        if (over && (view[0] > times.whole[0] || view[1] < times.whole[1])) {
            const bar = box.parentNode.insertBefore(document.createElement('p'), box);
            const button = bar.appendChild(document.createElement('button'));
            bar.className = 'controls';
            button.type = 'button';
            let whole = false;
            const label =
                () => { button.textContent = whole ? 'Show the event' : 'Show the whole time'; };
            button.onclick = () => {
                whole = !whole;
                show(whole ? times.whole : times.event);
                label();
            };
            label();
        }
        window.bolidePlots.push({plots, times, view : () => view});
    }
}
