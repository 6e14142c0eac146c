	.text
	.file	"bilateral.f32x4.cl"
	.section	.rodata.cst4,"aM",@progbits,4
	.p2align	2                               # -- Begin function bilateral
.LCPI0_0:
	.long	0x3f800000                      # float 1
.LCPI0_1:
	.long	0xc2800000                      # float -64
.LCPI0_2:
	.long	0xbf000000                      # float -0.5
.LCPI0_3:
	.long	0x3aaddd0a                      # float 0.00132647273
.LCPI0_4:
	.long	0x3c1e7544                      # float 0.00967151299
.LCPI0_5:
	.long	0x3d635ba9                      # float 0.0555073358
.LCPI0_6:
	.long	0x3e75fcde                      # float 0.240222424
.LCPI0_7:
	.long	0x3f317215                      # float 0.693147003
	.section	.rodata,"a",@progbits
	.p2align	6
.LCPI0_8:
	.zero	64
	.text
	.globl	bilateral
	.p2align	4, 0x90
	.type	bilateral,@function
bilateral:                              # @bilateral
	.cfi_startproc
# %bb.0:
	pushq	%rbp
	.cfi_def_cfa_offset 16
	.cfi_offset %rbp, -16
	movq	%rsp, %rbp
	.cfi_def_cfa_register %rbp
	pushq	%r15
	pushq	%r14
	pushq	%r13
	pushq	%r12
	pushq	%rbx
	andq	$-64, %rsp
	subq	$1984, %rsp                     # imm = 0x7C0
	.cfi_offset %rbx, -56
	.cfi_offset %r12, -48
	.cfi_offset %r13, -40
	.cfi_offset %r14, -32
	.cfi_offset %r15, -24
	movq	%r9, 544(%rsp)                  # 8-byte Spill
	movq	%rcx, 40(%rsp)                  # 8-byte Spill
	movq	%rdx, 56(%rsp)                  # 8-byte Spill
	movq	%rdi, 248(%rsp)                 # 8-byte Spill
	xorl	%edi, %edi
	callq	_Z13get_global_idj@PLT
	movslq	%eax, %rbx
	shlq	$4, %rbx
	movl	$1, %edi
	callq	_Z13get_global_idj@PLT
	movq	%rax, %r14
	movslq	16(%rbp), %rax
	cmpl	%eax, %ebx
	jge	.LBB0_88
# %bb.1:
	leaq	16(%rbp), %rcx
	movslq	4(%rcx), %r12
	cmpl	%r14d, %r12d
	jle	.LBB0_88
# %bb.2:
	movq	%rax, 48(%rsp)                  # 8-byte Spill
	leal	-1(%r12), %esi
	movl	%r14d, %edi
	movl	%esi, 240(%rsp)                 # 4-byte Spill
	movq	%rcx, %r15
	callq	_Z3minii@PLT
	movslq	16(%r15), %rdi
	movslq	20(%r15), %r8
	movq	%rbx, %rcx
	addq	%r8, %rcx
	cltq
	movq	%rdi, %rdx
	imulq	%rax, %rdx
	movq	248(%rsp), %rsi                 # 8-byte Reload
	leaq	(%rsi,%rdx,4), %rdx
	vmovups	(%rdx,%rcx,4), %zmm0
	vmovaps	%zmm0, 1152(%rsp)               # 64-byte Spill
	leaq	(%r12,%rax), %rdx
	imulq	%rdi, %rdx
	leaq	(%rsi,%rdx,4), %rdx
	vmovups	(%rdx,%rcx,4), %zmm0
	vmovaps	%zmm0, 1088(%rsp)               # 64-byte Spill
	leaq	(%r12,%r12), %rdx
	movq	%rdx, 512(%rsp)                 # 8-byte Spill
	leaq	(%rax,%r12,2), %rax
	movq	%rdi, 528(%rsp)                 # 8-byte Spill
	imulq	%rdi, %rax
	leaq	(%rsi,%rax,4), %rax
	vmovups	(%rax,%rcx,4), %zmm0
	vmovaps	%zmm0, 1024(%rsp)               # 64-byte Spill
	vbroadcastss	56(%r15), %zmm0
	vmovaps	%zmm0, 1792(%rsp)               # 64-byte Spill
	movq	%rbx, 496(%rsp)                 # 8-byte Spill
	movslq	%ebx, %rcx
	movq	%r14, 488(%rsp)                 # 8-byte Spill
	movslq	%r14d, %rax
	movq	%rax, 504(%rsp)                 # 8-byte Spill
	movq	%rcx, %rax
	movq	%rcx, 32(%rsp)                  # 8-byte Spill
	addq	%rcx, %r8
	movq	%r8, 520(%rsp)                  # 8-byte Spill
	vbroadcastss	.LCPI0_0(%rip), %zmm0   # zmm0 = [1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0]
	movq	$-4, %rbx
	vbroadcastss	.LCPI0_1(%rip), %zmm1   # zmm1 = [-6.4E+1,-6.4E+1,-6.4E+1,-6.4E+1,-6.4E+1,-6.4E+1,-6.4E+1,-6.4E+1,-6.4E+1,-6.4E+1,-6.4E+1,-6.4E+1,-6.4E+1,-6.4E+1,-6.4E+1,-6.4E+1]
	vmovaps	%zmm1, 1664(%rsp)               # 64-byte Spill
	vbroadcastss	.LCPI0_2(%rip), %zmm1   # zmm1 = [-5.0E-1,-5.0E-1,-5.0E-1,-5.0E-1,-5.0E-1,-5.0E-1,-5.0E-1,-5.0E-1,-5.0E-1,-5.0E-1,-5.0E-1,-5.0E-1,-5.0E-1,-5.0E-1,-5.0E-1,-5.0E-1]
	vmovaps	%zmm1, 1600(%rsp)               # 64-byte Spill
	vbroadcastss	.LCPI0_3(%rip), %zmm1   # zmm1 = [1.32647273E-3,1.32647273E-3,1.32647273E-3,1.32647273E-3,1.32647273E-3,1.32647273E-3,1.32647273E-3,1.32647273E-3,1.32647273E-3,1.32647273E-3,1.32647273E-3,1.32647273E-3,1.32647273E-3,1.32647273E-3,1.32647273E-3,1.32647273E-3]
	vmovaps	%zmm1, 1536(%rsp)               # 64-byte Spill
	vbroadcastss	.LCPI0_4(%rip), %zmm1   # zmm1 = [9.67151299E-3,9.67151299E-3,9.67151299E-3,9.67151299E-3,9.67151299E-3,9.67151299E-3,9.67151299E-3,9.67151299E-3,9.67151299E-3,9.67151299E-3,9.67151299E-3,9.67151299E-3,9.67151299E-3,9.67151299E-3,9.67151299E-3,9.67151299E-3]
	vmovaps	%zmm1, 1472(%rsp)               # 64-byte Spill
	vbroadcastss	.LCPI0_5(%rip), %zmm1   # zmm1 = [5.55073358E-2,5.55073358E-2,5.55073358E-2,5.55073358E-2,5.55073358E-2,5.55073358E-2,5.55073358E-2,5.55073358E-2,5.55073358E-2,5.55073358E-2,5.55073358E-2,5.55073358E-2,5.55073358E-2,5.55073358E-2,5.55073358E-2,5.55073358E-2]
	vmovaps	%zmm1, 1408(%rsp)               # 64-byte Spill
	vbroadcastss	.LCPI0_6(%rip), %zmm1   # zmm1 = [2.40222424E-1,2.40222424E-1,2.40222424E-1,2.40222424E-1,2.40222424E-1,2.40222424E-1,2.40222424E-1,2.40222424E-1,2.40222424E-1,2.40222424E-1,2.40222424E-1,2.40222424E-1,2.40222424E-1,2.40222424E-1,2.40222424E-1,2.40222424E-1]
	vmovaps	%zmm1, 1344(%rsp)               # 64-byte Spill
	vbroadcastss	.LCPI0_7(%rip), %zmm1   # zmm1 = [6.93147003E-1,6.93147003E-1,6.93147003E-1,6.93147003E-1,6.93147003E-1,6.93147003E-1,6.93147003E-1,6.93147003E-1,6.93147003E-1,6.93147003E-1,6.93147003E-1,6.93147003E-1,6.93147003E-1,6.93147003E-1,6.93147003E-1,6.93147003E-1]
	vmovaps	%zmm1, 1280(%rsp)               # 64-byte Spill
	vbroadcastss	.LCPI0_0(%rip), %zmm1   # zmm1 = [1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0,1.0E+0]
	vmovaps	%zmm1, 1216(%rsp)               # 64-byte Spill
	vxorps	%xmm1, %xmm1, %xmm1
	vmovaps	%zmm1, 128(%rsp)                # 64-byte Spill
	vxorps	%xmm1, %xmm1, %xmm1
	vmovaps	%zmm1, 64(%rsp)                 # 64-byte Spill
	vxorps	%xmm1, %xmm1, %xmm1
	vmovaps	%zmm1, 896(%rsp)                # 64-byte Spill
	vmovaps	%zmm0, 1728(%rsp)               # 64-byte Spill
	vmovaps	%zmm0, 960(%rsp)                # 64-byte Spill
	movq	%r12, 536(%rsp)                 # 8-byte Spill
	movq	544(%rsp), %r13                 # 8-byte Reload
	jmp	.LBB0_3
	.p2align	4, 0x90
.LBB0_7:                                #   in Loop: Header=BB0_3 Depth=1
	incq	%rbx
	cmpq	$5, %rbx
	movq	536(%rsp), %r12                 # 8-byte Reload
	je	.LBB0_8
.LBB0_3:                                # =>This Loop Header: Depth=1
                                        #     Child Loop BB0_90 Depth 2
	movq	%rbx, %rax
	addq	504(%rsp), %rax                 # 8-byte Folded Reload
	js	.LBB0_5
# %bb.4:                                #   in Loop: Header=BB0_3 Depth=1
	cmpq	%r12, %rax
	jl	.LBB0_6
.LBB0_5:                                #   in Loop: Header=BB0_3 Depth=1
	movl	%eax, %edi
	xorl	%esi, %esi
	movl	240(%rsp), %edx                 # 4-byte Reload
	vzeroupper
	callq	_Z5clampiii@PLT
                                        # kill: def $eax killed $eax def $rax
.LBB0_6:                                #   in Loop: Header=BB0_3 Depth=1
	movq	%rbx, %r15
	imulq	%rbx, %r15
	movl	%ebx, %ecx
	negl	%ecx
	movl	%ecx, 244(%rsp)                 # 4-byte Spill
	cltq
	movq	528(%rsp), %rsi                 # 8-byte Reload
	movq	%rsi, %rcx
	imulq	%rax, %rcx
	leaq	(%r12,%rax), %rdx
	imulq	%rsi, %rdx
	addq	512(%rsp), %rax                 # 8-byte Folded Reload
	imulq	%rsi, %rax
	movq	520(%rsp), %rdi                 # 8-byte Reload
	addq	%rdi, %rcx
	movq	248(%rsp), %rsi                 # 8-byte Reload
	leaq	(%rsi,%rcx,4), %rcx
	movq	%rcx, 568(%rsp)                 # 8-byte Spill
	addq	%rdi, %rdx
	leaq	(%rsi,%rdx,4), %rcx
	movq	%rcx, 560(%rsp)                 # 8-byte Spill
	addq	%rdi, %rax
	leaq	(%rsi,%rax,4), %rax
	movq	%rax, 552(%rsp)                 # 8-byte Spill
	movq	$-4, %r14
	movl	$4, %r12d
	jmp	.LBB0_90
	.p2align	4, 0x90
.LBB0_89:                               #   in Loop: Header=BB0_90 Depth=2
	incq	%r14
	decl	%r12d
	cmpq	$5, %r14
	je	.LBB0_7
.LBB0_90:                               #   Parent Loop BB0_3 Depth=1
                                        # =>  This Inner Loop Header: Depth=2
	movl	%r14d, %eax
	imull	%eax, %eax
	addl	%r15d, %eax
	cmpl	$16, %eax
	ja	.LBB0_89
# %bb.91:                               #   in Loop: Header=BB0_90 Depth=2
	movq	%r14, %rax
	orq	%rbx, %rax
	je	.LBB0_89
# %bb.92:                               #   in Loop: Header=BB0_90 Depth=2
	movq	568(%rsp), %rax                 # 8-byte Reload
	vmovups	(%rax,%r14,4), %zmm0
	vmovaps	%zmm0, 832(%rsp)                # 64-byte Spill
	movq	560(%rsp), %rax                 # 8-byte Reload
	vmovups	(%rax,%r14,4), %zmm0
	vmovaps	%zmm0, 768(%rsp)                # 64-byte Spill
	movq	552(%rsp), %rax                 # 8-byte Reload
	vmovups	(%rax,%r14,4), %zmm0
	vmovaps	%zmm0, 704(%rsp)                # 64-byte Spill
	movl	%r14d, %edi
	movl	%r12d, %esi
	vzeroupper
	callq	_Z3maxii@PLT
	cltq
	vmovss	(%r13,%rax,4), %xmm0            # xmm0 = mem[0],zero,zero,zero
	vmovss	%xmm0, 640(%rsp)                # 4-byte Spill
	movl	%ebx, %edi
	movl	244(%rsp), %esi                 # 4-byte Reload
	callq	_Z3maxii@PLT
	cltq
	vmovss	640(%rsp), %xmm0                # 4-byte Reload
                                        # xmm0 = mem[0],zero,zero,zero
	vaddss	(%r13,%rax,4), %xmm0, %xmm0
	vmovaps	%xmm0, 640(%rsp)                # 16-byte Spill
	vmovaps	832(%rsp), %zmm0                # 64-byte Reload
	vsubps	1152(%rsp), %zmm0, %zmm0        # 64-byte Folded Reload
	vmovaps	%zmm0, 832(%rsp)                # 64-byte Spill
	callq	_Z4fabsDv16_f@PLT
	vaddps	.LCPI0_8(%rip), %zmm0, %zmm0
	vmovaps	%zmm0, 576(%rsp)                # 64-byte Spill
	vmovaps	768(%rsp), %zmm0                # 64-byte Reload
	vsubps	1088(%rsp), %zmm0, %zmm0        # 64-byte Folded Reload
	vmovaps	%zmm0, 768(%rsp)                # 64-byte Spill
	callq	_Z4fabsDv16_f@PLT
	vaddps	576(%rsp), %zmm0, %zmm0         # 64-byte Folded Reload
	vmovaps	%zmm0, 576(%rsp)                # 64-byte Spill
	vmovaps	704(%rsp), %zmm0                # 64-byte Reload
	vsubps	1024(%rsp), %zmm0, %zmm0        # 64-byte Folded Reload
	vmovaps	%zmm0, 704(%rsp)                # 64-byte Spill
	callq	_Z4fabsDv16_f@PLT
	vaddps	576(%rsp), %zmm0, %zmm0         # 64-byte Folded Reload
	vbroadcastss	640(%rsp), %zmm1        # 16-byte Folded Reload
	vmulps	%zmm0, %zmm0, %zmm0
	vmulps	1792(%rsp), %zmm0, %zmm0        # 64-byte Folded Reload
	vsubps	%zmm0, %zmm1, %zmm1
	vmovaps	1664(%rsp), %zmm0               # 64-byte Reload
	vcmpleps	%zmm1, %zmm0, %k0
	vpmovm2d	%k0, %zmm2
	vmovdqa64	%zmm2, 640(%rsp)        # 64-byte Spill
	callq	_Z6selectDv16_fS_Dv16_i@PLT
	vmovaps	%zmm0, 1856(%rsp)               # 64-byte Spill
	vaddps	1600(%rsp), %zmm0, %zmm0        # 64-byte Folded Reload
	callq	_Z13convert_int16Dv16_f@PLT
	vmovaps	%zmm0, 576(%rsp)                # 64-byte Spill
	callq	_Z15convert_float16Dv16_i@PLT
	vmovaps	1856(%rsp), %zmm1               # 64-byte Reload
	vsubps	%zmm0, %zmm1, %zmm0
	vmulps	1536(%rsp), %zmm0, %zmm1        # 64-byte Folded Reload
	vaddps	1472(%rsp), %zmm1, %zmm1        # 64-byte Folded Reload
	vmulps	%zmm1, %zmm0, %zmm1
	vaddps	1408(%rsp), %zmm1, %zmm1        # 64-byte Folded Reload
	vmulps	%zmm1, %zmm0, %zmm1
	vaddps	1344(%rsp), %zmm1, %zmm1        # 64-byte Folded Reload
	vmulps	%zmm1, %zmm0, %zmm1
	vaddps	1280(%rsp), %zmm1, %zmm1        # 64-byte Folded Reload
	vmulps	%zmm1, %zmm0, %zmm0
	vaddps	1728(%rsp), %zmm0, %zmm0        # 64-byte Folded Reload
	vpslld	$23, 576(%rsp), %zmm1           # 64-byte Folded Reload
	vpaddd	1216(%rsp), %zmm1, %zmm1        # 64-byte Folded Reload
	vmulps	%zmm1, %zmm0, %zmm1
	vxorps	%xmm0, %xmm0, %xmm0
	vmovaps	640(%rsp), %zmm2                # 64-byte Reload
	callq	_Z6selectDv16_fS_Dv16_i@PLT
	vmulps	832(%rsp), %zmm0, %zmm1         # 64-byte Folded Reload
	vmovaps	896(%rsp), %zmm2                # 64-byte Reload
	vaddps	%zmm1, %zmm2, %zmm2
	vmovaps	%zmm2, 896(%rsp)                # 64-byte Spill
	vmulps	768(%rsp), %zmm0, %zmm1         # 64-byte Folded Reload
	vmovaps	64(%rsp), %zmm2                 # 64-byte Reload
	vaddps	%zmm1, %zmm2, %zmm2
	vmovaps	%zmm2, 64(%rsp)                 # 64-byte Spill
	vmulps	704(%rsp), %zmm0, %zmm1         # 64-byte Folded Reload
	vmovaps	128(%rsp), %zmm2                # 64-byte Reload
	vaddps	%zmm1, %zmm2, %zmm2
	vmovaps	%zmm2, 128(%rsp)                # 64-byte Spill
	vmovaps	960(%rsp), %zmm1                # 64-byte Reload
	vaddps	%zmm0, %zmm1, %zmm1
	vmovaps	%zmm1, 960(%rsp)                # 64-byte Spill
	jmp	.LBB0_89
.LBB0_8:
	vmovaps	960(%rsp), %zmm1                # 64-byte Reload
	vmovaps	896(%rsp), %zmm0                # 64-byte Reload
	vdivps	%zmm1, %zmm0, %zmm0
	vaddps	1152(%rsp), %zmm0, %zmm0        # 64-byte Folded Reload
	vmovaps	%zmm0, 256(%rsp)
	vmovaps	64(%rsp), %zmm0                 # 64-byte Reload
	vdivps	%zmm1, %zmm0, %zmm0
	vaddps	1088(%rsp), %zmm0, %zmm0        # 64-byte Folded Reload
	vmovaps	%zmm0, 320(%rsp)
	vmovaps	128(%rsp), %zmm0                # 64-byte Reload
	vdivps	%zmm1, %zmm0, %zmm0
	vaddps	1024(%rsp), %zmm0, %zmm0        # 64-byte Folded Reload
	vmovaps	%zmm0, 384(%rsp)
	leaq	16(%rbp), %rcx
	movslq	8(%rcx), %r14
	movslq	488(%rsp), %rax                 # 4-byte Folded Reload
	imulq	%rax, %r14
	movslq	12(%rcx), %rcx
	imulq	%rax, %rcx
	shlq	$4, %rcx
	addq	%rcx, 40(%rsp)                  # 8-byte Folded Spill
	movq	48(%rsp), %rcx                  # 8-byte Reload
	cmpl	%ecx, 496(%rsp)                 # 4-byte Folded Reload
	jge	.LBB0_13
# %bb.9:
	movq	32(%rsp), %rax                  # 8-byte Reload
	addq	%r14, %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	256(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 256(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_12
# %bb.10:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_12
# %bb.11:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 256(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_12:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	movq	32(%rsp), %rax                  # 8-byte Reload
	shlq	$4, %rax
	movq	40(%rsp), %rcx                  # 8-byte Reload
	vmovaps	%xmm0, (%rcx,%rax)
	movq	48(%rsp), %rcx                  # 8-byte Reload
.LBB0_13:
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$1, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_14
# %bb.18:
	movq	%rax, %rbx
	orq	$2, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_19
.LBB0_23:
	movq	%rax, %rbx
	orq	$3, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_24
.LBB0_28:
	movq	%rax, %rbx
	orq	$4, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_29
.LBB0_33:
	movq	%rax, %rbx
	orq	$5, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_34
.LBB0_38:
	movq	%rax, %rbx
	orq	$6, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_39
.LBB0_43:
	movq	%rax, %rbx
	orq	$7, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_44
.LBB0_48:
	movq	%rax, %rbx
	orq	$8, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_49
.LBB0_53:
	movq	%rax, %rbx
	orq	$9, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_54
.LBB0_58:
	movq	%rax, %rbx
	orq	$10, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_59
.LBB0_63:
	movq	%rax, %rbx
	orq	$11, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_64
.LBB0_68:
	movq	%rax, %rbx
	orq	$12, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_69
.LBB0_73:
	movq	%rax, %rbx
	orq	$13, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_74
.LBB0_78:
	movq	%rax, %rbx
	orq	$14, %rbx
	cmpq	%rcx, %rbx
	jl	.LBB0_79
.LBB0_83:
	orq	$15, %rax
	cmpq	%rcx, %rax
	jl	.LBB0_84
	jmp	.LBB0_88
.LBB0_14:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	260(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 260(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_17
# %bb.15:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_17
# %bb.16:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 260(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_17:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$2, %rbx
	cmpq	%rcx, %rbx
	jge	.LBB0_23
.LBB0_19:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	264(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 264(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_22
# %bb.20:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_22
# %bb.21:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 264(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_22:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$3, %rbx
	cmpq	%rcx, %rbx
	jge	.LBB0_28
.LBB0_24:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	268(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 268(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_27
# %bb.25:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_27
# %bb.26:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 268(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_27:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$4, %rbx
	cmpq	%rcx, %rbx
	jge	.LBB0_33
.LBB0_29:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	272(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 272(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_32
# %bb.30:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_32
# %bb.31:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 272(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_32:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$5, %rbx
	cmpq	%rcx, %rbx
	jge	.LBB0_38
.LBB0_34:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	276(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 276(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_37
# %bb.35:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_37
# %bb.36:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 276(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_37:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$6, %rbx
	cmpq	%rcx, %rbx
	jge	.LBB0_43
.LBB0_39:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	280(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 280(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_42
# %bb.40:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_42
# %bb.41:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 280(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_42:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$7, %rbx
	cmpq	%rcx, %rbx
	jge	.LBB0_48
.LBB0_44:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	284(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 284(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_47
# %bb.45:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_47
# %bb.46:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 284(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_47:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$8, %rbx
	cmpq	%rcx, %rbx
	jge	.LBB0_53
.LBB0_49:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	288(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 288(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_52
# %bb.50:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_52
# %bb.51:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 288(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_52:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$9, %rbx
	cmpq	%rcx, %rbx
	jge	.LBB0_58
.LBB0_54:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	292(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 292(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_57
# %bb.55:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_57
# %bb.56:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 292(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_57:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$10, %rbx
	cmpq	%rcx, %rbx
	jge	.LBB0_63
.LBB0_59:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	296(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 296(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_62
# %bb.60:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_62
# %bb.61:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 296(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_62:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$11, %rbx
	cmpq	%rcx, %rbx
	jge	.LBB0_68
.LBB0_64:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	300(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 300(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_67
# %bb.65:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_67
# %bb.66:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 300(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_67:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$12, %rbx
	cmpq	%rcx, %rbx
	jge	.LBB0_73
.LBB0_69:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	304(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 304(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_72
# %bb.70:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_72
# %bb.71:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 304(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_72:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$13, %rbx
	cmpq	%rcx, %rbx
	jge	.LBB0_78
.LBB0_74:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	308(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 308(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_77
# %bb.75:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_77
# %bb.76:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 308(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_77:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	movq	%rax, %rbx
	orq	$14, %rbx
	cmpq	%rcx, %rbx
	jge	.LBB0_83
.LBB0_79:
	leaq	(%rbx,%r14), %rax
	shlq	$4, %rax
	movq	56(%rsp), %rcx                  # 8-byte Reload
	vmovaps	(%rcx,%rax), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	312(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 312(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_82
# %bb.80:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_82
# %bb.81:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 312(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_82:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
	movq	32(%rsp), %rax                  # 8-byte Reload
	movq	48(%rsp), %rcx                  # 8-byte Reload
	orq	$15, %rax
	cmpq	%rcx, %rax
	jge	.LBB0_88
.LBB0_84:
	movq	%rax, %rbx
	addq	%rax, %r14
	shlq	$4, %r14
	movq	56(%rsp), %rax                  # 8-byte Reload
	vmovaps	(%rax,%r14), %xmm0
	vmovaps	%xmm0, 128(%rsp)                # 16-byte Spill
	xorl	%edi, %edi
	movl	$2, %esi
	vzeroupper
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovss	316(%rsp,%rax), %xmm0           # xmm0 = mem[0],zero,zero,zero
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$1, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	cltq
	shlq	$6, %rax
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$16, 316(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0],mem[0],xmm0[2,3]
	vmovaps	%xmm0, 64(%rsp)                 # 16-byte Spill
	movl	$2, %edi
	movl	$2, %esi
	callq	_Z3minii@PLT
	vmovaps	128(%rsp), %xmm2                # 16-byte Reload
	vsubps	%xmm2, %xmm2, %xmm0
	vhaddps	%xmm0, %xmm0, %xmm0
	cltq
	shlq	$6, %rax
	vmovshdup	%xmm0, %xmm1            # xmm1 = xmm0[1,1,3,3]
	vaddss	%xmm1, %xmm0, %xmm0
	vxorps	%xmm1, %xmm1, %xmm1
	vucomiss	%xmm1, %xmm0
	vmovaps	%xmm2, %xmm1
	vmovaps	%xmm2, %xmm0
	jne	.LBB0_87
# %bb.85:
	vmovaps	%xmm1, %xmm0
	jp	.LBB0_87
# %bb.86:
	vmovaps	64(%rsp), %xmm0                 # 16-byte Reload
	vinsertps	$32, 316(%rsp,%rax), %xmm0, %xmm0 # xmm0 = xmm0[0,1],mem[0],xmm0[3]
.LBB0_87:
	vblendps	$8, %xmm1, %xmm0, %xmm0         # xmm0 = xmm0[0,1,2],xmm1[3]
	shlq	$4, %rbx
	movq	40(%rsp), %rax                  # 8-byte Reload
	vmovaps	%xmm0, (%rax,%rbx)
.LBB0_88:
	leaq	-40(%rbp), %rsp
	popq	%rbx
	popq	%r12
	popq	%r13
	popq	%r14
	popq	%r15
	popq	%rbp
	.cfi_def_cfa %rsp, 8
	vzeroupper
	retq
.Lfunc_end0:
	.size	bilateral, .Lfunc_end0-bilateral
	.cfi_endproc
                                        # -- End function
	.ident	"Debian clang version 14.0.6"
	.section	".note.GNU-stack","",@progbits
	.addrsig
