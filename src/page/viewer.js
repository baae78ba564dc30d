// The viewer: particles as spheres by WebGL 2, from the data of the page (src/page/view.c).
'use strict';
(async () => {
    const $ = id => document.getElementById(id);
    const M = JSON.parse($('meta').textContent);
    const t0 = performance.now();
    async function blob(id) {
        const s = atob($(id).textContent.trim()), u = new Uint8Array(s.length);
        for (let i = 0; i < s.length; i++) u[i] = s.charCodeAt(i);
        const r =
            new Response(new Blob([ u ]).stream().pipeThrough(new DecompressionStream('deflate')));
        return new Uint8Array(await r.arrayBuffer());
    }
    const N = M.count, T = M.times.length;
    // still: body, radius; frames: differences from the frame before, byte planes (low x y z, high
    // x y z, fields)
    const still = await blob('still'), bodyOf = still.subarray(0, N),
          radiusOf = still.subarray(N, 2 * N);
    // order 1: to the frame before; 2: of positions to where free flight takes them
    const frames = [];
    let last = null, before = null;
    for (let f = 0; f < T; f++) {
        const d = await blob('f' + f), order = +$('f' + f).dataset.order,
              pos = new Uint16Array(3 * N), fields = [];
        for (let a = 0; a < 3; a++)
            for (let i = 0, lo = a * N, hi = (3 + a) * N; i < N; i++) {
                const v = d[lo + i] | d[hi + i] << 8, k = 3 * i + a;
                pos[k] = order === 0   ? v
                         : order === 1 ? last.pos[k] + v
                                       : 2 * last.pos[k] - before.pos[k] + v;
            }
        for (let k = 0; k < M.fields.length; k++) {
            const s = d.subarray((6 + k) * N, (7 + k) * N), o = new Uint8Array(N);
            for (let i = 0; i < N; i++) o[i] = last ? last.fields[k][i] + s[i] : s[i];
            fields.push(o);
        }
        before = last;
        frames.push(last = {pos, fields});
    }
    const loadMs = performance.now() - t0;
    const canvas = $('gl'), over = $('over'),
          gl = canvas.getContext('webgl2', {antialias : false, preserveDrawingBuffer : true});
    if (!gl) {
        $('note').textContent = 'This browser draws no WebGL 2.';
        return;
    }
    const VS = `#version 300 es
in vec3 pos; in float val, bod, rad;
uniform mat4 view, proj; uniform vec3 lo, span, mir, mat; uniform float rmax, minpx, focal, ortho;
  uniform vec2 range; uniform float logr; uniform vec2 vspan; uniform uint show;
out float u; flat out float bo; out vec3 c; flat out float r; flat out float px;
void main(){
  vec3 p=lo+span*pos; p=mat+(p-mat)*mir; c=(view*vec4(p,1)).xyz; r=rmax*rad; bo=bod;
  uint b=uint(bod*255.0+.5);
  gl_Position=proj*vec4(c,1);
  px=focal*r/(ortho>0.0?ortho:-c.z); float d=max(2.0*px,minpx); r*=d/(2.0*px); gl_PointSize=d;
  if((show>>b&1u)==0u||min(pos.x,min(pos.y,pos.z))>=1.0) gl_Position=vec4(9,9,9,1);
  float v=vspan.x+val*(vspan.y-vspan.x);
  u=logr>0.0?(log(max(v,1e-30))-log(range.x))/(log(range.y)-log(range.x)):
    (v-range.x)/(range.y-range.x);
}`;
    const FS = `#version 300 es
precision highp float;
in float u; flat in float bo; in vec3 c; flat in float r; flat in float px;
uniform mat4 view, proj; uniform sampler2D ramp; uniform float cat, ortho, plain; uniform vec4 cut[3];
  uniform int cuts;
layout(location=0) out vec4 col;
void main(){
  vec2 q=vec2(gl_PointCoord.x*2.0-1.0,1.0-gl_PointCoord.y*2.0); float d2=dot(q,q);
    if(d2>1.0)discard;
  vec3 n=vec3(q,sqrt(1.0-d2)); vec3 p=c+r*n;
  vec3 w=ortho>0.0?vec3(0,0,-1):normalize(p);
  if(cuts>0){ float far=1e30; bool inside=true; vec3 cn;
    for(int i=0;i<3;i++) if(i<cuts){ float s=dot(cut[i].xyz,p)-cut[i].w; if(s<=0.0){inside=false;
      break;}
      float rate=dot(cut[i].xyz,w); if(rate<0.0&&s/-rate<far){far=s/-rate;cn=cut[i].xyz;} }
    if(inside){ if(far>1e29)discard; p+=w*far; vec3 e=p-c; if(dot(e,e)>r*r)discard; n=cn; } }
  vec4 s=proj*vec4(p,1); gl_FragDepth=.5*s.z/s.w+.5;
  vec3 base=cat>0.0?texelFetch(ramp,ivec2(int(bo*255.0+.5)%8,1),0).rgb:
    texture(ramp,vec2(clamp(u,0.0,1.0)*.996+.002,.25)).rgb;
  float l=plain>0.0?1.0:px<2.0?.85:.45+.55*max(0.0,dot(n,normalize(vec3(-.5,.7,1))));
  col=vec4(base*l,1);
}`;
    const QV = `#version 300 es
void main(){gl_Position=vec4(vec2((gl_VertexID<<1)&2,gl_VertexID&2)*2.0-1.0,0,1);}`;
    const QF = `#version 300 es
precision highp float; uniform sampler2D colour, depth; uniform vec2 nf;
  uniform float ortho, strength; out vec4 o;
float lin(float d){ return ortho>0.0? nf.x+d*(nf.y-nf.x) : nf.x*nf.y/(nf.y-d*(nf.y-nf.x)); }
void main(){ ivec2 p=ivec2(gl_FragCoord.xy), m=textureSize(depth,0)-1;
  float d=texelFetch(depth,p,0).r; vec4 c=texelFetch(colour,p,0);
  float z=log2(lin(d)), s=0.0;
  for(int ring=1;ring<=2;ring++) for(int i=0;i<8;i++){ float a=float(i)*.7854;
    ivec2 q=clamp(p+ivec2(round(vec2(cos(a),sin(a))*float(ring)*(ring==1?1.5:3.0))),ivec2(0),m);
    float dq=texelFetch(depth,q,0).r; s+=max(0.0,min(z-log2(lin(dq)),.02)); }
  if(d>=1.0){ o=vec4(mix(vec3(1),vec3(.25),min(1.0,0.0*s)),1); return; }
  o=vec4(c.rgb*exp(-strength*s/16.0),1); }`;
    function program(v, f) {
        const p = gl.createProgram();
        for (const [t, s] of [[ gl.VERTEX_SHADER, v ], [ gl.FRAGMENT_SHADER, f ]]) {
            const h = gl.createShader(t);
            gl.shaderSource(h, s);
            gl.compileShader(h);
            if (!gl.getShaderParameter(h, gl.COMPILE_STATUS)) throw gl.getShaderInfoLog(h);
            gl.attachShader(p, h);
        }
        gl.linkProgram(p);
        if (!gl.getProgramParameter(p, gl.LINK_STATUS)) throw gl.getProgramInfoLog(p);
        return p;
    }
    const P = program(VS, FS), Q = program(QV, QF), U = n => gl.getUniformLocation(P, n);
    const buf = {};
    for (const b of ['pos', 'val', 'bod', 'rad']) buf[b] = gl.createBuffer();
    const vao = gl.createVertexArray();
    gl.bindVertexArray(vao);
    for (const [b, n, t] of [[ 'pos', 3, gl.UNSIGNED_SHORT ], [ 'val', 1, gl.UNSIGNED_BYTE ],
                             [ 'bod', 1, gl.UNSIGNED_BYTE ], [ 'rad', 1, gl.UNSIGNED_BYTE ]]) {
        gl.bindBuffer(gl.ARRAY_BUFFER, buf[b]);
        const at = gl.getAttribLocation(P, b);
        if (at < 0) continue;
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, n, t, true, 0, 0);
    }
    const put = (b, d) => {
        gl.bindBuffer(gl.ARRAY_BUFFER, buf[b]);
        gl.bufferData(gl.ARRAY_BUFFER, d, gl.DYNAMIC_DRAW);
    };
    put('bod', bodyOf);
    put('rad', radiusOf);
    const V = [
        [ 68, 1, 84 ], [ 72, 40, 120 ], [ 62, 74, 137 ], [ 49, 104, 142 ], [ 38, 130, 142 ],
        [ 31, 158, 137 ], [ 53, 183, 121 ], [ 110, 206, 88 ], [ 181, 222, 43 ], [ 253, 231, 37 ]
    ];
    const C = [ 0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9, 0x777777, 0xf0e442 ];
    const tex = gl.createTexture(), R = new Uint8Array(256 * 2 * 4);
    for (let i = 0; i < 256; i++) {
        const x = i / 255 * 9, j = Math.min(8, x | 0), f = x - j;
        for (let a = 0; a < 3; a++) R[4 * i + a] = V[j][a] * (1 - f) + V[j + 1][a] * f;
        R[4 * i + 3] = 255;
        if (i < 8) {
            R[1024 + 4 * i] = C[i] >> 16;
            R[1025 + 4 * i] = C[i] >> 8 & 255;
            R[1026 + 4 * i] = C[i] & 255;
            R[1027 + 4 * i] = 255;
        }
    }
    gl.bindTexture(gl.TEXTURE_2D, tex);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 256, 2, 0, gl.RGBA, gl.UNSIGNED_BYTE, R);
    for (const k of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
        gl.texParameteri(gl.TEXTURE_2D, k, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    const fb = gl.createFramebuffer(), ct = gl.createTexture(), dt = gl.createTexture();
    let fw = 0, fh = 0;
    function target(w, h) {
        if (w === fw && h === fh) return;
        fw = w;
        fh = h;
        for (const [t, i, f,
                    y] of [[ ct, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE ],
                           [ dt, gl.DEPTH_COMPONENT24, gl.DEPTH_COMPONENT, gl.UNSIGNED_INT ]]) {
            gl.bindTexture(gl.TEXTURE_2D, t);
            gl.texImage2D(gl.TEXTURE_2D, 0, i, w, h, 0, f, y, null);
            for (const k of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER])
                gl.texParameteri(gl.TEXTURE_2D, k, gl.NEAREST);
        }
        gl.bindFramebuffer(gl.FRAMEBUFFER, fb);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, ct, 0);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, dt, 0);
    }
    // ------------------------------------------------------------------ state and controls
    const S = Object.assign({
        post : !M.flat,
        frame : T - 1,
        field : -1,
        low : 0,
        high : 1,
        log : false,
        ortho : M.flat,
        show : 2 ** 32 - 1,
        mirror : [...M.mirror ],
        cut : M.cut,
        az : M.flat ? -90 : 30,
        el : M.flat ? 0 : 25,
        dist : M.flat ? 0 : 1.9, // 0: all fits
        at : null,
        min : 1.6,
        shade : 60
    },
                            M.state || {});
    const lo = M.window.lo, hi = M.window.hi;
    function box() {
        const l = [...lo ], h = [...hi ];
        for (const a of S.mirror) {
            const c = M.at[a], m = Math.max(Math.abs(l[a] - c), Math.abs(h[a] - c));
            l[a] = c - m;
            h[a] = c + m;
        }
        return [ l, h ];
    }
    const size = () => {
        const [l, h] = box();
        return Math.hypot(h[0] - l[0], h[1] - l[1], h[2] - l[2]);
    };
    const sub = (a, b) => a.map((x, i) => x - b[i]),
          dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
          cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                             a[0] * b[1] - a[1] * b[0]],
          unit = a => {
              const l = Math.hypot(...a);
              return a.map(x => x / l);
          };
    let cam;
    // how far away the eye is from what just fits, in units of size()
    function fit(aspect) {
        const [l, u] = box(), tall = Math.max(u[1] - l[1], (u[0] - l[0]) / aspect);
        return 1.25 * tall / (2 * Math.tan(15 * Math.PI / 180) * size());
    }
    function camera(w, h) {
        S.dist = S.dist || fit(w / h);
        const [l, u] = box(), at = S.at || l.map((x, i) => (x + u[i]) / 2),
                  e = S.el * Math.PI / 180, z = S.az * Math.PI / 180, up = M.up,
                  ax = M.flat ? [ 1, 0, 0 ]
                              : [ 0, 1, 2 ].map(i => +(i === (up.findIndex(x => x) + 1) % 3)),
                  ay = cross(up, ax);
        const from = ax.map((_, i) => Math.cos(e) * Math.cos(z) * ax[i] +
                                      Math.cos(e) * Math.sin(z) * ay[i] + Math.sin(e) * up[i]),
              d = S.dist * size(), eye = at.map((x, i) => x + d * from[i]);
        const F = from.map(x => -x), Rt = unit(cross(F, up)), Up = cross(Rt, F);
        const view = [
            Rt[0], Up[0], from[0], 0, Rt[1], Up[1], from[1], 0, Rt[2], Up[2], from[2], 0,
            -dot(Rt, eye), -dot(Up, eye), -dot(from, eye), 1
        ];
        const fy = 1 / Math.tan(15 * Math.PI / 180), asp = w / h,
              nf = [ Math.max(d - 1.2 * size(), .02 * d), d + 1.2 * size() ], [ n, f ] = nf;
        let proj;
        if (S.ortho)
            proj = [
                fy / d / asp, 0, 0, 0, 0, fy / d, 0, 0, 0, 0, -2 / (f - n), 0, 0, 0,
                -(f + n) / (f - n), 1
            ];
        else
            proj = [
                fy / asp, 0, 0, 0, 0, fy, 0, 0, 0, 0, -(f + n) / (f - n), -1, 0, 0,
                -2 * f * n / (f - n), 0
            ];
        cam = {view, proj, nf, focal : fy * h / 2, d, from, Rt, Up, at, eye, w, h};
        return cam;
    }
    function project(p) {
        const e = sub(p, cam.eye), z = S.ortho ? cam.d : -dot(e, cam.from);
        return [
            cam.w / 2 + cam.focal * dot(e, cam.Rt) / z, cam.h / 2 - cam.focal * dot(e, cam.Up) / z
        ];
    }
    let shown = [ -1, -1 ], moving = 0, settle = 0;
    const move = () => {
        moving = performance.now();
        clearTimeout(settle);
        settle = setTimeout(() => {
            moving = 0;
            requestAnimationFrame(draw);
        }, 250);
        requestAnimationFrame(draw);
    };
    function draw() {
        const r = devicePixelRatio || 1, w = canvas.clientWidth * r | 0,
              h = canvas.clientHeight * r | 0;
        if (canvas.width !== w || canvas.height !== h) {
            canvas.width = over.width = w;
            canvas.height = over.height = h;
        }
        target(w, h);
        camera(w, h);
        if (shown[0] !== S.frame) put('pos', frames[S.frame].pos);
        if (shown[0] !== S.frame || shown[1] !== S.field)
            put('val', S.field < 0 ? bodyOf : frames[S.frame].fields[S.field]);
        shown = [ S.frame, S.field ];
        const post = S.post && !moving, drawn = moving && N > 1e5 ? 1e5 : N;
        gl.bindFramebuffer(gl.FRAMEBUFFER, post ? fb : null);
        gl.viewport(0, 0, w, h);
        gl.clearColor(1, 1, 1, 1);
        gl.enable(gl.DEPTH_TEST);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.useProgram(P);
        gl.bindVertexArray(vao);
        gl.uniformMatrix4fv(U('view'), false, cam.view);
        gl.uniformMatrix4fv(U('proj'), false, cam.proj);
        gl.uniform3fv(U('lo'), M.lo);
        gl.uniform3fv(U('mat'), M.at);
        gl.uniform3fv(U('span'), M.span);
        // in the plane neighbours touch, and nothing has a shade
        gl.uniform1f(U('rmax'), M.rmax * (M.flat ? 1.3 : 1));
        gl.uniform1f(U('plain'), +M.flat);
        gl.uniform1f(U('minpx'), S.min * r);
        gl.uniform1f(U('focal'), cam.focal);
        gl.uniform1f(U('ortho'), S.ortho ? cam.d : 0);
        gl.uniform2f(U('range'), S.low, S.high);
        gl.uniform1f(U('logr'), S.log ? 1 : 0);
        const fd = M.fields[Math.max(0, S.field)];
        gl.uniform2f(U('vspan'), fd.low, fd.high);
        gl.uniform1ui(U('show'), S.show >>> 0);
        gl.uniform1f(U('cat'), S.field < 0 ? 1 : 0);
        const cuts = (S.cut.match(/[+-][xyz][^+-]*(?:e-?\d+)?/g) || []).map(s => {
            const a = 'xyz'.indexOf(s[1]), sg = s[0] === '+' ? 1 : -1, n = [ 0, 0, 0 ];
            n[a] = sg;
            const d = sg * (parseFloat(s.slice(2)) / M.mm || 0);
            return {n, d};
        });
        const cv = new Float32Array(12);
        cuts.forEach((c, i) => {
            const n = [ dot(c.n, cam.Rt), dot(c.n, cam.Up), dot(c.n, cam.from) ];
            cv.set([...n, c.d - dot(c.n, cam.eye) ], 4 * i);
        });
        gl.uniform4fv(U('cut'), cv);
        gl.uniform1i(U('cuts'), cuts.length);
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D, tex);
        gl.uniform1i(U('ramp'), 0);
        for (let k = 0; k < 1 << S.mirror.length; k++) {
            const m = [ 1, 1, 1 ];
            S.mirror.forEach((a, j) => {
                if (k >> j & 1) m[a] = -1;
            });
            gl.uniform3fv(U('mir'), m);
            gl.drawArrays(gl.POINTS, 0, drawn);
        }
        if (!post) {
            axes(r);
            return;
        }
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.disable(gl.DEPTH_TEST);
        gl.useProgram(Q);
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D, ct);
        gl.activeTexture(gl.TEXTURE1);
        gl.bindTexture(gl.TEXTURE_2D, dt);
        const u = n => gl.getUniformLocation(Q, n);
        gl.uniform1i(u('colour'), 0);
        gl.uniform1i(u('depth'), 1);
        gl.uniform2fv(u('nf'), cam.nf);
        gl.uniform1f(u('ortho'), S.ortho ? 1 : 0);
        gl.uniform1f(u('strength'), S.shade * 3);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        axes(r);
    }
    function axes(r) {
        const g = over.getContext('2d');
        g.clearRect(0, 0, over.width, over.height);
        const [l, h] = box();
        g.font = 12 * r + 'px sans-serif';
        g.lineWidth = r;
        g.textAlign = 'center';
        g.textBaseline = 'middle';
        const mid = project(l.map((x, i) => (x + h[i]) / 2));
        for (let a = 0; a < 3; a++) {
            const b = (a + 1) % 3, c = (a + 2) % 3;
            let best = null;
            for (let k = 0; k < 4; k++) {
                const fb_ = !!(k & 1) === cam.from[b] > 0, fc = !!(k & 2) === cam.from[c] > 0,
                      p = [...l ], q = [...h ];
                p[b] = q[b] = k & 1 ? h[b] : l[b];
                p[c] = q[c] = k & 2 ? h[c] : l[c];
                p[a] = l[a];
                q[a] = h[a];
                const A = project(p), B = project(q);
                if (fb_ === fc) {
                    continue;
                }
                const sc = A[1] + B[1] - .3 * (A[0] + B[0]);
                if (!best || sc > best.sc) best = {sc, A, B, p};
            }
            if (!best) continue;
            const {A, B, p} = best;
            g.strokeStyle = '#999';
            g.fillStyle = '#444';
            g.beginPath();
            g.moveTo(...A);
            g.lineTo(...B);
            g.stroke();
            let n = [ -(B[1] - A[1]), B[0] - A[0] ];
            const L = Math.hypot(...n);
            if (L < 60 * r) continue;
            n = n.map(x => x / L);
            if (n[0] * ((A[0] + B[0]) / 2 - mid[0]) + n[1] * ((A[1] + B[1]) / 2 - mid[1]) < 0)
                n = n.map(x => -x);
            const span = (h[a] - l[a]) * M.mm;
            let st = 10 ** Math.floor(Math.log10(span / 3));
            st *= span / st > 20 ? 5 : span / st > 10 ? 2 : 1;
            for (let v = Math.ceil(l[a] * M.mm / st) * st; v <= h[a] * M.mm; v += st) {
                const q = [...p ];
                q[a] = v / M.mm;
                const s = project(q);
                g.beginPath();
                g.moveTo(...s);
                g.lineTo(s[0] + 5 * r * n[0], s[1] + 5 * r * n[1]);
                g.stroke();
                g.fillText(+v.toPrecision(6), s[0] + 15 * r * n[0], s[1] + 14 * r * n[1]);
            }
            const name = 'xyz'[a] + ' (' + M.unit + ')', wide = g.measureText(name).width / 2;
            g.fillText(name, (A[0] + B[0]) / 2 + (28 * r + wide) * n[0],
                       (A[1] + B[1]) / 2 + 32 * r * n[1]);
        }
    }
    function bar() {
        const b = $('bar'), f = M.fields[S.field];
        b.style.visibility = f ? 'visible' : 'hidden';
        if (!f) return;
        $('barlow').textContent = (S.low / f.scale).toPrecision(3);
        $('barhigh').textContent = (S.high / f.scale).toPrecision(3) + ' ' + f.unit;
    }
    const sync = () => {
        $('time').value = S.frame;
        $('t').textContent = M.times[S.frame];
        if (S.field >= 0) {
            const f = M.fields[S.field];
            $('low').value = +(S.low / f.scale).toPrecision(4);
            $('high').value = +(S.high / f.scale).toPrecision(4);
        }
        bar();
        draw();
    };
    $('time').max = T - 1;
    $('time').oninput = e => {
        S.frame = +e.target.value;
        sync();
    };
    M.fields.forEach((f, i) => $('field').add(new Option(f.name, i)));
    $('field').value = S.field;
    $('field').onchange = e => {
        S.field = +e.target.value;
        if (S.field >= 0) {
            S.low = M.fields[S.field].low;
            S.high = M.fields[S.field].high;
        }
        sync();
    };
    for (const k of ['low', 'high'])
        $(k).onchange = e => {
            S[k] = e.target.value * M.fields[S.field].scale;
            sync();
        };
    $('log').onchange = e => {
        S.log = e.target.checked;
        if (S.log && S.low <= 0) S.low = S.high * 1e-3;
        sync();
    };
    $('ortho').onchange = e => {
        S.ortho = e.target.checked;
        sync();
    };
    $('cut').onchange = e => {
        S.cut = e.target.value;
        sync();
    };
    $('cut').value = S.cut;
    $('min').oninput = e => {
        S.min = +e.target.value;
        sync();
    };
    if (M.bodies.length < 25)
        M.bodies.forEach((b, i) => {
            const l = document.createElement('label'), c = document.createElement('input');
            c.type = 'checkbox';
            c.checked = S.show >>> i & 1;
            c.onchange = () => {
                S.show ^= 1 << i;
                sync();
            };
            const k = document.createElement('i');
            k.style.background = '#' + C[i % 8].toString(16).padStart(6, '0');
            l.append(c, k, b);
            $('bodies').append(l);
        });
    M.mirror.forEach(a => {
        const l = document.createElement('label'), c = document.createElement('input');
        c.type = 'checkbox';
        c.checked = S.mirror.includes(a);
        c.onchange = () => {
            S.mirror = c.checked ? [...S.mirror, a ] : S.mirror.filter(x => x !== a);
            sync();
        };
        l.append(c, 'mirrored at ' +
                        'xyz'[a] + ' = ' + +(M.at[a] * M.mm).toPrecision(4) + ' ' + M.unit);
        $('mirrors').append(l);
    });
    let playing = null;
    $('play').onclick = () => {
        if (playing) {
            clearInterval(playing);
            playing = null;
            $('play').textContent = '▶ Play';
        } else {
            $('play').textContent = '⏸ Pause';
            playing = setInterval(() => {
                S.frame = (S.frame + 1) % T;
                sync();
            }, 120);
        }
    };
    let drag = null;
    over.onpointerdown = e => {
        drag = [ e.clientX, e.clientY, e.button || e.shiftKey || (M.flat && !e.ctrlKey) ];
        over.setPointerCapture(e.pointerId);
    };
    over.onpointerup = () => drag = null;
    over.oncontextmenu = e => e.preventDefault();
    over.onpointermove = e => {
        if (!drag) return;
        const dx = e.clientX - drag[0], dy = e.clientY - drag[1];
        drag[0] = e.clientX;
        drag[1] = e.clientY;
        if (drag[2]) {
            const k = cam.d / cam.focal * (devicePixelRatio || 1);
            S.at = cam.at.map((x, i) => x - k * (dx * cam.Rt[i] - dy * cam.Up[i]));
        } else {
            if (!M.flat || e.ctrlKey) {
                S.az -= dx * .4;
                S.el = Math.max(-89, Math.min(89, S.el + dy * .4));
            }
        }
        move();
    };
    over.onwheel = e => {
        e.preventDefault();
        S.dist *= Math.exp(e.deltaY * .001);
        move();
    };
    window.onresize = draw;
    sync();
    {
        const g = $('scale').getContext('2d'), image = g.createImageData(256, 1);
        image.data.set(R.subarray(0, 1024));
        g.putImageData(image, 0, 0);
    }
    $('min').value = S.min;
    $('ortho').checked = S.ortho;
    const first = JSON.stringify(S);
    $('reset').onclick = () => {
        moving = 0;
        clearTimeout(settle);
        Object.assign(S, JSON.parse(first));
        S.show = S.show >>> 0;
        for (const c of document.querySelectorAll('#bodies input, #mirrors input'))
            c.checked = true;
        $('field').value = S.field;
        $('cut').value = S.cut;
        $('ortho').checked = S.ortho;
        $('log').checked = S.log;
        $('min').value = S.min;
        sync();
    };
    if (M.stride > 1 || M.left > 0)
        $('note').textContent += ' This page holds ' + T + ' of ' + (T + M.left) + ' snapshots' +
                                 (M.stride > 1 ? ' and one of ' + M.stride + ' particles.' : '.');
    window.bolide = {
        S,
        sync,
        draw,
        loadMs,
        time(n) {
            const t = performance.now(), px = new Uint8Array(4);
            for (let i = 0; i < n; i++) {
                S.frame = i % T;
                S.az += 1;
                sync();
                gl.readPixels(5, 5, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, px);
            }
            return (performance.now() - t) / n;
        }
    };
    window.bolide.ready = true;
})().catch(e => {
    document.getElementById('note').textContent = e;
    window.bolideFailed = String(e);
});
